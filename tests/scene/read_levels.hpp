#pragma once

#include "core/scene/scene.hpp"
#include "tests/input/support.hpp"

// Reads the sections Grid and AMR of scenes.

namespace tushar::scene {

using simulation::Criterion;
using Strings = std::vector<std::string>;

/// The result of reading the sections Grid and AMR.
struct Read {
  grid::Domain domain;
  AmrSettings amr;
  Strings problems, notes;

  const grid::Refinement& refinement() const { return domain.refinement; }
};

inline Strings sentencesOf(const std::vector<InputProblem>& problems) {
  Strings sentences;
  for (const InputProblem& problem : problems) sentences.push_back(problem.tagPath + ": " + problem.sentence);
  return sentences;
}

inline Read read(const std::string& grid, const std::string& amr = "", const grid::Workers& workers = {},
                 int fewestCellsOfBlock = 4) {
  input::Diagnostics diagnostics;
  const input::Document document =
      input::Document::parse(input::scene("<Grid>" + grid + "</Grid>" + amr), "s.ups", diagnostics);
  Read read;
  if (const auto section = document.root().child("AMR")) read.amr = readAmr(*section, nullptr, diagnostics);
  read.amr.fewestCellsOfBlock = fewestCellsOfBlock;
  read.domain = readGrid(*document.root().child("Grid"), {}, workers, read.amr, diagnostics);
  read.problems = sentencesOf(diagnostics.sorted());
  read.notes = sentencesOf(diagnostics.notes());
  return read;
}

inline std::string box(const std::string& lower, const std::string& upper, const std::string& cells,
                       const std::string& more = "") {
  return "<Box><lower>[" + lower + "]</lower><upper>[" + upper + "]</upper><resolution>[" + cells + "]</resolution>" +
         more + "</Box>";
}
inline std::string level(const std::string& boxes) { return "<Level>" + boxes + "</Level>"; }

/// A square of 32² cells without extent along z.
inline const std::string square = level(box("0,0,0", "2,1,0", "64,32,1"));
inline const std::string halved = level(box(".5,.25,0", "1,.5,0", "32,16,1"));

inline std::string amr(const std::string& regridder, const std::string& more = "") {
  return "<AMR><Regridder type=\"Tiled\">" + regridder + "</Regridder>" + more + "</AMR>";
}
inline const std::string adaptive = "<adaptive>true</adaptive>";
inline const std::string criteria =
    "<Euler><Refinement_Criteria_Thresholds><Variable name=\"c.density\" value=\".02\"/>"
    "</Refinement_Criteria_Thresholds></Euler>";
inline std::string variable(const std::string& attributes) {
  return "<AMR><ICE><Refinement_Criteria_Thresholds><Variable " + attributes +
         "/></Refinement_Criteria_Thresholds></ICE></AMR>";
}

}  // namespace tushar::scene
