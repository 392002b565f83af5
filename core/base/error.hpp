#pragma once

#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tushar {

/// The exit codes of `sus`.
enum class ExitCode : int {
  success = 0,
  failure = 1,         ///< any other failure: a file that cannot be written, lack of memory, a bug
  badCommandLine = 2,  ///< an unknown option
  badInput = 3,        ///< the scene cannot be run as it is written
  numerical = 4,       ///< a value became non-finite or unphysical during the run
  interrupted = 5,     ///< ended early by Ctrl-C or SIGTERM, with its output written
};

/// A place in a scene file, or the option on the command line that overrides it.
struct Location {
  std::string file;  ///< file name as the user gave it, or `--set PATH=VALUE` for an override
  int line = 0;      ///< line number, from 1; 0 if the location is not a line of a file
  int column = 0;    ///< column number in bytes, from 1; 0 if the whole line is meant

  /// Whether the location is an option on the command line.
  bool isOption() const { return line == 0 && !file.empty(); }
  /// Returns `file:line:column`, `file:line` if there is no column, or `file` alone if there is no line.
  std::string text() const;
};

/// Returns where to report an invalid combination of values that are given in several `parts` of a tag: at the
/// command-line option that overrides one of these parts or, if there is none, at `tag`.
const Location& placeOf(std::initializer_list<const Location*> parts, const Location& tag);
const Location& placeOf(std::initializer_list<const Location*> parts, const Location&& tag) = delete;  // would dangle

/// One mistake in a scene, described in one sentence.
struct InputProblem {
  Location where;
  std::string tagPath;   ///< path of the tag, such as `Grid/Level/Box/resolution`; may be empty
  std::string sentence;  ///< the message: what was found, what is allowed, and the closest valid name if there is one

  /// Returns the complete message: `scene.ups:12:7: Grid/Level: …`
  std::string text() const;
};

/// Exception with all mistakes in a scene, thrown once after the whole file has been read.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<InputProblem> problems);
  const std::vector<InputProblem>& problems() const { return problems_; }

 private:
  std::vector<InputProblem> problems_;
};

/// Exception for a task list that cannot be run because of a mistake in the component.
class TaskError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Exception for a non-finite or unphysical value; says which value it is, where and when it occurred, and what the
/// user can try.
class NumericalError : public std::runtime_error {
 public:
  /// `what` is the message, which names the value and its position; `advice` is a suggestion to the user, by default
  /// that of the component. `value` is the bare name of the value, and `cell` the index of its cell. If several patches
  /// report an error, the one with the lowest cell index is kept, so that the layout does not matter.
  NumericalError(const std::string& what, std::string advice, std::string value = {}, std::uint64_t cell = 0)
      : std::runtime_error(what), advice_(std::move(advice)), value_(std::move(value)), cell_(cell) {}
  const std::string& advice() const { return advice_; }
  const std::string& value() const { return value_; }
  std::uint64_t cell() const { return cell_; }

 private:
  std::string advice_, value_;
  std::uint64_t cell_;
};

/// Exception for a file or folder that cannot be read or written; gives its path and the system's reason.
class FileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns ` (did you mean 'x'?)` for the candidate most similar to `word`, or nothing if none is similar.
std::string didYouMean(std::string_view word, const std::vector<std::string>& candidates);

/// Returns a list of alternatives as text: `'a', 'b' or 'c'`.
std::string alternatives(const std::vector<std::string>& words);
/// Returns a list as text: `'a', 'b' and 'c'`.
std::string allOf(const std::vector<std::string>& words);

/// Returns a number with its noun in singular or plural: `1 cell`, `2 cells`.
std::string counted(long count, std::string_view noun);

}  // namespace tushar
