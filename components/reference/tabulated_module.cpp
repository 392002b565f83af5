#include <stdexcept>

#include "components/reference/gas_module.hpp"
#include "components/reference/modules.hpp"
#include "components/reference/tabulated.hpp"
#include "core/base/error.hpp"

namespace tushar::reference {

using input::Diagnostics;
using input::Element;
using input::Schema;
using simulation::AnalysisKind;

namespace {

struct TableSection : GasTags {
  std::string file;
};
const Schema<TableSection>& tableSchema() {
  static const Schema<TableSection> schema = [] {
    Schema<TableSection> declared("Module",
                                  "Errors against the cells of another run, of higher resolution, at the time and in "
                                  "the box of its output. Internal energy is a mean by mass.");
    declareGasTags(declared, "tabulated");
    declared
        .required(
            "file", &TableSection::file, "1",
            "an output (.h5) with c.density, c.velocity and c.pressure, or what tools/coarsen made of it; relative "
            "to the scene")
        .ours();
    return declared;
  }();
  return schema;
}

}  // namespace

AnalysisKind tabulatedKind() {
  AnalysisKind kind{"tabulated", "errors against the cells of another run", {}, {}};
  kind.describe = [](std::ostream& out) { tableSchema().describe(out); };
  kind.schema = [] { return &tableSchema(); };
  kind.read = [](const Element& module, Diagnostics& diagnostics) {
    return readModule(tableSchema(), module, diagnostics, [](const TableSection& read, const grid::Level&) {
      try {
        return std::make_shared<Tabulated>(readGasTable(read.file, read.gamma));
      } catch (const FileError& error) {
        throw std::invalid_argument(error.what());
      }
    });
  };
  return kind;
}

}  // namespace tushar::reference
