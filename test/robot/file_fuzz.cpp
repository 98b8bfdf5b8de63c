// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: robot_file_fuzz [FILES [SEED]]
// Changes bytes, words and elements of a robot's files at random. Each is read, and then answers
// queries, or is refused in one line that begins with our name; nothing else may happen.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>

#include "files/tetrahedron.h"
#include "robot/robot_files.h"

namespace kios::testing {
namespace {

const char* const kSrdf =
    "<robot name='arm'>\n<virtual_joint name='v' type='fixed' parent_frame='w' "
    "child_link='base'/>\n"
    "<disable_collisions link1='cart' link2='upper' reason='Never'/>\n"
    "<disable_default_collisions link='left'/>\n<enable_collisions link1='base' link2='left'/>\n"
    "<group_state name='home' group='g'><joint name='elbow' value='1.5'/>"
    "<joint name='drive' value='1 2 3'/></group_state>\n</robot>\n";

std::size_t below(Random& random, std::size_t n) {
  return n == 0 ? 0 : std::min(n - 1, static_cast<std::size_t>(random.unit() * n));
}

/// Mangles elements and lines, words and numbers, bytes: dropped, doubled, swapped or replaced.
std::string changed(std::string text, Random& random) {
  static const std::vector<std::string> kWords = [] {
    std::vector<std::string> words = {"", "|"};
    std::istringstream all(
        "nan|inf|-1|0|1e308|1e-320|1e999|''|<robot>|</link>|-0|<!--|&lt;|[|]|{|}|: |\n|\t|*x|&x|"
        "null|true|base|upper|\xff\xfe|99999999999999999999|0x10|1,5|<![CDATA[|!!binary|---");
    for (std::string word; std::getline(all, word, '|');) words.push_back(word);
    return words;
  }();
  const int changes = random.unit() < 0.7 ? 1 : 3;
  for (int i = 0; i < changes && !text.empty(); ++i) {
    const std::size_t at = below(random, text.size());
    const auto partAt = [&](std::size_t from, std::size_t& begin, std::size_t& end) {
      const bool line = random.unit() < 0.5;
      const char *const first = line ? "\n" : "<[{ '\"", *const last = line ? "\n" : ">]} '\"";
      begin = text.find_last_of(first, from);
      begin = begin == std::string::npos ? 0 : begin;
      end = text.find_first_of(last, begin + 1);
      end = end == std::string::npos ? text.size() : end + 1;
    };
    std::size_t begin = 0, end = 0, other_begin = 0, other_end = 0;
    switch (below(random, 7)) {
      case 0:
        text[at] = static_cast<char>(below(random, 256));
        break;
      case 1:
        text.erase(at, 1 + below(random, 8));
        break;
      case 2:
        partAt(at, begin, end);
        text.erase(begin, end - begin);
        break;
      case 3:
        partAt(at, begin, end);
        text.insert(end, text.substr(begin, end - begin));
        break;
      case 4: {
        partAt(at, begin, end);
        partAt(below(random, text.size()), other_begin, other_end);
        const std::string part = text.substr(other_begin, other_end - other_begin);
        text.replace(begin, end - begin, part);
        break;
      }
      case 5: {  // a number or a name
        begin = text.find_first_of("0123456789", at);
        if (begin == std::string::npos) begin = at;
        end = text.find_first_not_of("0123456789.-e", begin);
        if (end == std::string::npos) end = text.size();
        text.replace(begin, end - begin, kWords[below(random, kWords.size())]);
        break;
      }
      default:
        text.insert(at, kWords[below(random, kWords.size())]);
    }
  }
  return text;
}

struct Tally {
  int read = 0, refused = 0, faults = 0;
};

void ask(const Robot& robot, Random& random) {
  VectorXd q(robot.coordinates());
  for (int i = 0; i < q.size(); ++i) q[i] = random.uniform(-2, 2);
  robot.contact(q);
  robot.clearance(q);
  robot.checkMotion(q, 0.9 * q);
  for (const std::string& state : robot.states()) robot.state(state);
}

/// What a mesh answers, alone and beside a sound one.
void ask(const std::shared_ptr<Modeld>& mesh, const Modeld& sound, Random& random) {
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.translation() = Vector3d(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
  const double d = distanceBracket(*mesh, X, sound, fcl::Transform3d::Identity()).distance;
  const bool close = closerThan(*mesh, X, sound, fcl::Transform3d::Identity(), 0.1);
  if (std::isnan(d) || d < 0 || (close && d > 0.1 * (1 + 1e-9))) throw std::logic_error("distance");
  fcl::CollisionResultd contacts;
  fcl::collide(mesh.get(), X, &sound, fcl::Transform3d::Identity(), fcl::CollisionRequestd(),
               contacts);
  if (contacts.isCollision() != (d == 0)) throw std::logic_error("contact and distance differ");
  if (inspectClosedness(*mesh).isSolid()) {
    markSolid(*mesh);
    contains(*mesh, X, Vector3d(0.1, 0.1, 0.1));
  }
}

void run(int files, std::uint64_t seed, Tally& tally) {
  const Folder folder;
  const std::string urdf = manyJoints(folder), urdf_text = contentOf(urdf);
  const std::string box = folder / "meshes/rod.obj", box_text = contentOf(box);
  const auto sound_mesh = loadMesh(box);
  const char* const kinds[] = {"obj", "off",        "coff",    "stl", "binary.stl",
                               "ply", "little.ply", "big.ply", "dae"};
  const Robot sound = loadRobot(urdf);
  Random random(seed);
  for (int i = 0; i < files; ++i) {
    std::string text;
    try {
      Robot robot = sound;
      switch (i % 4) {
        case 0:
          text = changed(urdf_text, random);
          robot = loadRobot(folder.write("changed.urdf", text));
          break;
        case 1:
          text = changed(kSrdf, random);
          robot = loadRobot(urdf, folder.write("changed.srdf", text));
          break;
        case 2:
          text = changed(kScene, random);
          robot.addScene(folder.write("changed.yaml", text));
          break;
        default: {
          const std::string kind = kinds[i / 4 % std::size(kinds)];
          text = changed(kind == "obj" ? box_text : tetrahedron(kind), random);
          const std::string ending = kind == "coff" ? "off" : kind.substr(kind.find('.') + 1);
          const auto mesh = loadMesh(folder.write("changed." + ending, text));
          robot.addObstacle("mesh", mesh);
          ask(mesh, *sound_mesh, random);
        }
      }
      ask(robot, random);
      ++tally.read;
    } catch (const std::invalid_argument& error) {
      ++tally.refused;
      const std::string message = error.what();
      const bool plain = message.rfind("fcl_kios: ", 0) == 0 &&
                         message.find('\n') == std::string::npos && message.size() < 2000;
      if (plain) continue;
      ++tally.faults;
      std::printf("file %d of seed %llu: %s\n", i, static_cast<unsigned long long>(seed),
                  error.what());
    } catch (const std::exception& error) {
      ++tally.faults;
      std::printf("file %d of seed %llu, %s\n%s\n", i, static_cast<unsigned long long>(seed),
                  error.what(), text.c_str());
    }
  }
}

}  // namespace
}  // namespace kios::testing

int main(int argc, char** argv) {
  kios::testing::Tally tally;
  const int files = argc > 1 ? std::atoi(argv[1]) : 4000;
  kios::testing::run(files, argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1, tally);
  std::printf("%d read, %d refused, %d faults\n", tally.read, tally.refused, tally.faults);
  return tally.faults == 0 && tally.read > files / 10 && tally.refused > files / 10 ? 0 : 1;
}
