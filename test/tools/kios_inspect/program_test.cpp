// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// kios_inspect as a user runs it: its output, exit codes and errors.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fcl_kios/distance.h"
#include "fcl_kios/model.h"
#include "sample_files.h"
#include "scenes/shapes.h"

namespace kios::inspect {
namespace {

using Json = nlohmann::json;

struct Outcome {
  int code;
  std::string out, err;
};

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string quoted(const std::filesystem::path& file) { return "'" + file.string() + "'"; }

Outcome run(const std::string& arguments) {
  const auto out = sampleFile("stdout"), err = sampleFile("stderr");
  const std::string command =
      std::string("'") + KIOS_INSPECT + "' " + arguments + " >" + quoted(out) + " 2>" + quoted(err);
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(out), contentOf(err)};
}

Json json(const std::string& arguments) {
  const Outcome outcome = run(arguments + " --json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return Json::parse(outcome.out, nullptr, false);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Program, JsonAndTextSayTheSame) {
  const auto file = writeObj("torus.obj", scenes::knobbyTorus());
  const Json mesh = json(quoted(file))["meshes"][0];
  EXPECT_EQ(mesh["triangles"], 3240);
  EXPECT_EQ(mesh["distinct_vertices"], 1620);
  EXPECT_EQ(mesh["surface"], "closed");
  EXPECT_EQ(mesh["nodes"], 6479);
  EXPECT_EQ(mesh["k"]["1"].get<int>() + mesh["k"]["3"].get<int>() + mesh["k"]["5"].get<int>(),
            6479);
  EXPECT_TRUE(mesh["warnings"].empty());
  EXPECT_EQ(mesh["self_intersections"]["crosses"], 0);
  EXPECT_EQ(mesh["levels"].size(), mesh["depth"].get<std::size_t>() + 1);
  const Outcome text = run(quoted(file) + " --quiet");
  EXPECT_EQ(text.code, 0);
  EXPECT_TRUE(contains(text.out, "3240 in 1 mesh, closed")) << text.out;
  EXPECT_TRUE(contains(text.out, "6479 in")) << text.out;
  EXPECT_TRUE(text.err.empty()) << text.err;
}

TEST(Program, TrianglesThatMeetAreCountedByKind) {
  const auto file = writeText("meet.obj",
                              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 -1\nv 0.2 0.2 1\nv 0.9 0.9 1\n"
                              "v 1 1 0\nv 0.5 0.5 0\nv 2 2 5\nf 1 2 3\nf 4 5 6\nf 7 8 9\n");
  const Json mesh = json(quoted(file))["meshes"][0];
  EXPECT_EQ(mesh["self_intersections"]["crosses"], 1);
  EXPECT_EQ(mesh["self_intersections"]["touches"], 1);
  EXPECT_EQ(mesh["self_intersections"]["overlaps"], 1);  // 1 and 2, both in x = y
  EXPECT_EQ(mesh["self_intersections"]["complete"], true);
  EXPECT_TRUE(contains(mesh["warnings"].dump(), "3 pairs of triangles that meet")) << mesh;
  EXPECT_EQ(run(quoted(file) + " --strict --quiet").code, 1);
}

TEST(Program, BadFilesAreRefusedInASentenceThatNamesThem) {
  const std::string whole = contentOf(writeStl("whole.stl", scenes::bentTorus()));
  const std::pair<std::filesystem::path, const char*> cases[] = {
      {sampleFile("missing.stl"), "no such file"},
      {sampleFile("x").parent_path(), "directory"},
      {writeText("empty.stl", ""), "empty"},
      {writeText("unknown", "this is not a mesh\n"), "can't be read as a mesh"},
      {writeText("cut.stl", whole.substr(0, whole.size() / 2)), "cut off"},
      {writeText("index.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n"), ":3: face 0 refers to vertex 9"},
  };
  for (const auto& [file, words] : cases) {
    for (const std::string& more : {std::string(), " --json --html " + quoted(sampleFile("h"))}) {
      const Outcome outcome = run(quoted(file) + more);
      EXPECT_EQ(outcome.code, 3) << file;
      EXPECT_TRUE(outcome.out.empty()) << outcome.out;
      EXPECT_TRUE(contains(outcome.err, file.string()) && contains(outcome.err, words))
          << outcome.err;
    }
  }
  EXPECT_FALSE(std::filesystem::exists(sampleFile("h")));
}

TEST(Program, FilesWithoutPermissionAreNamed) {
  const auto file = writeStl("secret.stl", scenes::bentTorus());
  std::filesystem::permissions(file, std::filesystem::perms::none);
  if (std::ifstream(file)) GTEST_SKIP() << "run by root, who may read everything";
  const Outcome outcome = run(quoted(file));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_TRUE(contains(outcome.err, "Permission denied")) << outcome.err;
}

TEST(Program, FilesThatCannotBeWrittenAreNamed) {
  const std::string mesh = quoted(writeStl("mesh.stl", scenes::bentTorus()));
  for (const std::string& out :
       std::vector<std::string>{" --html /nowhere/page.html", " --html /dev/full",
                                " --html " + quoted(sampleFile("x").parent_path())}) {
    const Outcome outcome = run(mesh + out);
    EXPECT_EQ(outcome.code, 4) << out;
    EXPECT_TRUE(contains(outcome.err, "no directory") || contains(outcome.err, "can't be written"))
        << outcome.err;
  }
}

TEST(Program, WrongCommandLinesAreRefused) {
  const std::string mesh = quoted(writeStl("mesh.stl", scenes::bentTorus()));
  for (const std::string& arguments :
       {std::string(), mesh + " " + mesh + " " + mesh, mesh + " --unknown", mesh + " --level -1",
        mesh + " --html-limit 0", mesh + " --level x", mesh + " --level 999",
        mesh + " --pose-a 1,2,3", mesh + " " + mesh + " --pose-b 1,2",
        mesh + " " + mesh + " --pose-b 1,2,x", mesh + " " + mesh + " --pose-b 1,2,nan",
        mesh + " " + mesh + " --pose-b 0,0,0,1,1,0,0", mesh + " " + mesh + " --pose-b 1,2,3,",
        mesh + " " + mesh + " --repeats 0"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_FALSE(outcome.err.empty()) << arguments;
  }
  EXPECT_EQ(run("--help").code, 0);
  EXPECT_TRUE(contains(run("--help").out, "exit codes"));
  EXPECT_EQ(run("--version").code, 0);
}

TEST(Program, StrictTurnsWarningsIntoAnExitCode) {
  const std::string clean = quoted(writeStl("clean.stl", scenes::bentTorus()));
  scenes::Mesh flawed = scenes::bentTorus();
  flawed.triangles.push_back(flawed.triangles[7]);
  const std::string file = quoted(writeStl("flawed.stl", flawed));
  EXPECT_EQ(run(clean + " --strict").code, 0);
  EXPECT_EQ(run(file).code, 0);
  const Outcome strict = run(file + " --strict");
  EXPECT_EQ(strict.code, 1);
  EXPECT_TRUE(contains(strict.out, "1 triangle with the corners of an earlier one, the first is " +
                                       std::to_string(flawed.triangles.size() - 1)))
      << strict.out;
}

TEST(Program, WhatAFileLosesIsWarnedOf) {
  const auto file = writeText("lines.obj",
                              "v 448262.3 4582940.7 0\nv 448262.5 4582940.7 0\n"
                              "v 448262.3 4582940.9 0\nf 1 2 3\nl 1 2\n");
  const Json mesh = json(quoted(file))["meshes"][0];
  EXPECT_EQ(mesh["defects"]["points_and_lines"], 1);
  EXPECT_TRUE(contains(mesh["warnings"].dump(), "1 point or line left out"));
  EXPECT_EQ(mesh["box"]["upper"][0].get<double>(), 448262.5);
  EXPECT_EQ(run(quoted(file) + " --strict").code, 1);
}

TEST(Program, TheDistanceOfTwoMeshesIsTheLibrarys) {
  // Coordinates that floats hold, as the files do.
  const auto onGrid = [](scenes::Mesh mesh) {
    for (fcl::Vector3d& v : mesh.vertices) v = (4096 * v).array().round() / 4096;
    return mesh;
  };
  const scenes::Mesh torus = onGrid(scenes::knobbyTorus()), blob = onGrid(scenes::bumpyBlob());
  const std::string files =
      quoted(writeStl("a.stl", torus)) + " " + quoted(writeStl("b.stl", blob));
  const auto a = makeModel(torus.vertices, torus.triangles);
  const auto b = makeModel(blob.vertices, blob.triangles);
  fcl::Transform3d X_WA = fcl::Transform3d::Identity(), X_WB = X_WA;
  X_WA.translation() = fcl::Vector3d(-1, 2.5, 0.25);
  X_WB.translation() = fcl::Vector3d(3, -0.5, 1);
  X_WB.linear() = fcl::Quaterniond(0.5, 0.5, -0.5, 0.5).toRotationMatrix();
  const Json pair =
      json(files + " --pose-a -1,2.5,0.25 --pose-b 3,-0.5,1,0.5,0.5,-0.5,0.5")["pair"];
  const auto expected = distanceBracket(*a, X_WA, *b, X_WB);
  EXPECT_EQ(pair["distance"].get<double>(), expected.distance);
  EXPECT_EQ(pair["triangle_a"], expected.triangle_a);
  EXPECT_EQ(pair["triangle_b"], expected.triangle_b);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(pair["point_a"][i].get<double>(), expected.point_a[i]);
    EXPECT_EQ(pair["point_b"][i].get<double>(), expected.point_b[i]);
  }
  EXPECT_GT(pair["median_us"].get<double>(), 0);
  EXPECT_LE(pair["min_us"].get<double>(), pair["median_us"].get<double>());

  EXPECT_EQ(json(files + " --pose-b 1,0,0")["pair"]["distance"].get<double>(), 0);
  EXPECT_TRUE(contains(run(files + " --pose-b 1,0,0").out, "touch or intersect"));
}

TEST(Program, PagesStandAloneAndSayWhatTheyLeaveOut) {
  const std::string mesh = quoted(writeStl("mesh.stl", scenes::bumpyTorus(20000)));
  const auto file = sampleFile("page.html");
  ASSERT_EQ(run(mesh + " --html " + quoted(file)).code, 0);
  const std::string whole = contentOf(file);
  for (const char* foreign : {"http:", "https:", "src=", "@import", "url("}) {
    EXPECT_FALSE(contains(whole, foreign)) << foreign;
  }
  EXPECT_FALSE(contains(whole, "left out,"));
  ASSERT_EQ(run(mesh + " --html-limit 0.5 --html " + quoted(file)).code, 0);
  const std::string small = contentOf(file);
  EXPECT_LT(small.size(), 600000u);
  EXPECT_TRUE(contains(small, "the mesh itself is left out"));
  EXPECT_TRUE(contains(small, "are left out, as the page would be too large"));
}

TEST(Program, LongWorkIsReportedOnStderr) {
  const std::string mesh = quoted(writeStl("mesh.stl", scenes::bumpyTorus(200000)));
  const Outcome loud = run(mesh + " --json");
  EXPECT_EQ(loud.code, 0);
  EXPECT_TRUE(contains(loud.err, " s\n")) << loud.err;
  EXPECT_FALSE(Json::parse(loud.out, nullptr, false).is_discarded());
  EXPECT_TRUE(run(mesh + " --quiet").err.empty());
}

}  // namespace
}  // namespace kios::inspect
