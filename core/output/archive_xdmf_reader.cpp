#include "core/output/archive_xdmf_reader.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <string_view>

#include "core/output/archive_xml.hpp"

namespace tushar::output {

namespace {

constexpr std::string_view atStep = " at step ";

int stepOfTime(const std::string& gridName) {
  const std::size_t at = gridName.rfind(atStep);
  return at == std::string::npos ? 0
                                 : static_cast<int>(std::strtol(gridName.c_str() + at + atStep.size(), nullptr, 10));
}

constexpr unsigned depthOfBlocks = depthOfOutputs - 1;

std::string nameOfGrid(const pugi::xml_node& grid) { return grid.attribute("Name").as_string(); }

/// Parses a text; the document is empty if the text is invalid.
pugi::xml_document parsed(const std::string& text) {
  pugi::xml_document document;
  if (!document.load_buffer(text.data(), text.size())) document.reset();
  return document;
}

/// The state of a reader: `depth` elements are open, and `text` is the part of the current output that has been read.
struct Place {
  const TakeOutput& take;
  unsigned depth = 0;
  std::string block{}, text{};
  bool isSound = true;

  void takeOutput() {
    const pugi::xml_document document = parsed(text);
    const pugi::xml_node grid = document.child("Grid");
    isSound = isSound && grid;
    if (grid) take(block, stepOfTime(nameOfGrid(grid)), grid);
    text.clear();
  }
};

/// Advances by a piece of the file that ends with a tag; `kind` is the first character of the tag's text.
void goOn(Place& place, const std::string& piece, std::size_t tag) {
  const char kind = piece[tag + 1];
  const bool isClosing = kind == '/', isEmpty = piece[piece.size() - 2] == '/';
  if (kind == '?' || kind == '!') return;
  if (place.depth == depthOfBlocks && !isClosing)
    place.block = nameOfGrid(parsed(piece.substr(tag) + "</Grid>").child("Grid"));
  if (isClosing) --place.depth;
  if (place.depth >= depthOfOutputs) place.text += piece;
  if (place.depth == depthOfOutputs && (isClosing || isEmpty)) place.takeOutput();
  if (!isClosing && !isEmpty) ++place.depth;
}

}  // namespace

std::string nameAtStep(const std::string& block, int step) { return fmt::format("{}{}{}", block, atStep, step); }

std::string headOfBlock(const std::string& name) {
  pugi::xml_document document;
  pugi::xml_node grid = document.append_child("Grid");
  set(grid, "Name", name, "GridType", "Collection", "CollectionType", "Temporal");
  grid.append_child("Grid");
  const std::string text = textOf(grid, depthOfBlocks);
  return text.substr(0, text.find('\n'));
}

bool readXdmf(const std::filesystem::path& file, const TakeOutput& take) {
  std::ifstream in(file, std::ios::binary);
  Place place{take};
  bool began = false;
  for (std::string piece; place.isSound && std::getline(in, piece, '>') && !in.eof();) {
    piece += '>';
    const std::size_t tag = piece.rfind('<');
    if (tag == std::string::npos) return false;
    goOn(place, piece, tag);
    began = began || place.depth > 0;
  }
  return place.isSound && began && place.depth == 0;
}

}  // namespace tushar::output
