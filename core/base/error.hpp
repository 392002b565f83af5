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
  std::string file;  ///< as the user named it; `--set PATH=VALUE` for an override
  int line = 0;      ///< from 1; 0 if there is no line
  int column = 0;    ///< counted in bytes, from 1

  /// Whether it is an option on the command line.
  bool isOption() const { return line == 0 && !file.empty(); }
  /// `file:line:column`, or `file` alone if there is no line.
  std::string text() const;
};

/// The place at which to report an invalid combination of several `parts` of a tag: the option that overrides one of
/// them, otherwise `tag`.
const Location& placeOf(std::initializer_list<const Location*> parts, const Location& tag);
const Location& placeOf(std::initializer_list<const Location*> parts, const Location&& tag) = delete;  // would dangle

/// One mistake in a scene, in one sentence.
struct InputProblem {
  Location where;
  std::string tagPath;   ///< `Grid/Level/Box/resolution`; may be empty
  std::string sentence;  ///< what was found, what is allowed, did-you-mean

  /// `scene.ups:12:7: Grid/Level: …`
  std::string text() const;
};

/// All mistakes in a scene: thrown once, after the whole file has been read.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<InputProblem> problems);
  const std::vector<InputProblem>& problems() const { return problems_; }

 private:
  std::vector<InputProblem> problems_;
};

/// A task list that cannot be run: a mistake in the component.
class TaskError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A non-finite or unphysical value: which one, where, when, and what the user can try.
class NumericalError : public std::runtime_error {
 public:
  /// `what` names the value and its position; `advice` says what to try; if empty, the advice of the component is used.
  /// `value` is the name of the value alone, `cell` the number of its cell: if several patches report an error, the one
  /// in the lowest cell is kept, so that the layout does not matter.
  NumericalError(const std::string& what, std::string advice, std::string value = {}, std::uint64_t cell = 0)
      : std::runtime_error(what), advice_(std::move(advice)), value_(std::move(value)), cell_(cell) {}
  const std::string& advice() const { return advice_; }
  const std::string& value() const { return value_; }
  std::uint64_t cell() const { return cell_; }

 private:
  std::string advice_, value_;
  std::uint64_t cell_;
};

/// A file or folder that cannot be read or written: the path and the system's reason.
class FileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// ` (did you mean 'x'?)` for the candidate most similar to `word` if there is a similar one, otherwise nothing.
std::string didYouMean(std::string_view word, const std::vector<std::string>& candidates);

/// `'a', 'b' or 'c'`.
std::string alternatives(const std::vector<std::string>& words);
/// `'a', 'b' and 'c'`.
std::string allOf(const std::vector<std::string>& words);

/// `1 cell`, `2 cells`.
std::string counted(long count, std::string_view noun);

}  // namespace tushar
