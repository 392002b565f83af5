#pragma once

#include <iosfwd>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/output/archive.hpp"

namespace tushar::output {

/// The contents of `index.xml`: the variables, globals and outputs of an archive.
class ArchiveIndex {
 public:
  static constexpr const char* rootName = "tushar_archive";
  /// Newest format; the number is raised if older readers would misread the archive.
  static constexpr int format = 2;
  static constexpr int uniformFormat = 1;  ///< format of archives with grids of one level

  explicit ArchiveIndex(std::string version) : version_(std::move(version)) {}
  /// Continues from the text of another index, without its outputs after `step`.
  ArchiveIndex(std::string version, const std::string& text, int step);

  /// Adds an output to the list. Returns whether it contains names that were not listed before.
  bool add(const Snapshot& snapshot);
  void add(const GlobalSample& sample, const std::string& file);
  std::vector<std::string> globals() const;
  /// Number of outputs up to a step in the text of an index.
  static std::size_t sizeOf(const std::string& text, int step) { return ArchiveIndex("", text, step).outputs_.size(); }
  /// The reason why an archive cannot be read (its index has a newer format); empty if it can.
  static std::string refusalOf(const std::string& text);
  /// The name of the variable whose datasets have a given name, in which some characters may have been replaced.
  std::string labelOf(const std::string& nameInFile) const;
  /// The steps of all outputs, ascending.
  std::vector<int> steps() const;
  bool lists(int step) const { return outputs_.contains(step); }
  /// The step of the last output; -1 if there is none.
  int lastStep() const { return outputs_.empty() ? -1 : outputs_.rbegin()->first; }
  /// The text of the whole file.
  std::string text() const;
  void write(std::ostream& out) const;

 private:
  struct Variable {
    std::string centring, unit, description, type;
    int components;
    std::set<std::string> materials;

    friend bool operator==(const Variable&, const Variable&) = default;
  };
  struct Global {
    std::string unit, description, file;
    std::size_t components;

    friend bool operator==(const Global&, const Global&) = default;
  };
  struct Output {
    double time, delT;
  };
  bool addVariable(const Array& array, const std::string& centring, const std::string& material);
  const std::string& head() const;

  std::string version_;
  int format_ = uniformFormat;  ///< format of this archive
  std::map<std::string, Variable> variables_;
  std::map<std::string, Global> globals_;
  std::map<int, Output> outputs_;  ///< outputs, by step
  /// The text before the list of outputs, which most checkpoints leave as it is; empty after a change.
  mutable std::string head_;
};

}  // namespace tushar::output
