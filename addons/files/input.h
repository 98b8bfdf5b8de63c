// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "read_mesh.h"

namespace kios::files {

/// A file in memory, behind which a line break stands.
struct Input {
  std::string name;
  std::string_view content;

  const char* end() const { return content.data() + content.size(); }
  /// "name:line: what", without the line where `at` is null.
  std::string sentence(const char* at, const std::string& what) const;
  /// Throws std::invalid_argument with such a sentence.
  [[noreturn]] void refuse(const char* at, const std::string& what) const;
};

/// A part of a file between quotation marks, cut short, of characters that can be printed.
std::string quoted(std::string_view part);

/// The length of the character of UTF-8 that begins a text, negative for controls; 0 if none does.
int lengthOfCharacter(std::string_view text);

/// Reads a number, whatever the locale; returns where it ends, null if it isn't a finite one. What
/// is too small for a double is 0.
const char* parseNumber(const char* at, const char* end, double& x);
const char* parseNumber(const char* at, const char* end, long long& x);

/// Words and numbers of a text, line by line. White space but line breaks separates them; a line
/// ends with a line feed, a carriage return or both.
class Text {
 public:
  /// `comment` begins one that ends with its line; 0: there are none. `continued`: a line goes on
  /// in the next after a backslash.
  Text(const Input& input, char comment, bool continued = false);

  /// The next word's place, or the line's end.
  const char* at();
  bool lineEnded() { return kind(*at()) >= kBreak; }
  /// Passes line breaks; whether nothing follows.
  bool ended();
  void nextLine();
  /// The next word of the line, which is empty at its end.
  std::string_view word();
  /// The words to the line's end, with a blank between two; the comment's sign is a letter.
  std::string name();
  double number();
  long long integer();
  std::size_t count();
  /// Where the next line begins after nextLine(), white space included.
  const char* place() const { return at_; }
  /// Goes to a place in the text.
  void moveTo(const char* place) { at_ = place; }
  [[noreturn]] void refuse(const std::string& what) { input_.refuse(at(), what); }
  /// A sentence where the last line isn't ended, and so may be a part of one.
  void warnOfOpenLine(Mesh& mesh) const;

 private:
  enum Kind : unsigned char { kWord, kBlank, kContinued, kBreak, kComment };
  Kind kind(char c) const { return kinds_[static_cast<unsigned char>(c)]; }
  template <typename Number>
  Number parse(const char* what);

  const Input& input_;
  const char* at_;
  const char comment_;
  std::array<Kind, 256> kinds_{};
};

/// The polygons of a file, which become triangles once all vertices are known.
class Faces {
 public:
  /// `base`: the number of the first vertex in the file.
  explicit Faces(const Input& input, int base = 0) : input_(input), base_(base) {}

  /// Polygons from here on are an object's: a new one's, or that of a number returned before.
  int beginObject(const std::string& name);
  void resumeObject(int object) { object_ = object; }
  /// Begins a polygon; its place, null where the file has no lines.
  void begin(const char* at) { faces_.push_back({corners_.size(), at, object_}); }
  void add(long long vertex) { corners_.push_back(vertex); }
  /// Appends the triangles, and warnings. Refuses vertices that aren't there, and a mesh without
  /// triangles.
  void finish(Mesh& mesh);

 private:
  const Input& input_;
  struct Face {
    std::size_t first;
    const char* at;
    int object;
  };
  int base_;
  int object_ = -1;
  std::vector<std::string> objects_;
  std::vector<Face> faces_;
  std::vector<long long> corners_;
};

/// "3 faces", "1 face".
std::string counted(std::size_t n, const std::string& one, const std::string& more);

Mesh readDae(const Input& input);
Mesh readObj(const Input& input);
Mesh readOff(const Input& input);
Mesh readPly(const Input& input);
Mesh readStl(const Input& input);
/// What assimp reads.
Mesh readOther(const Input& input);

}  // namespace kios::files
