#include <stdexcept>

#include "components/reference/gas_module.hpp"
#include "components/reference/modules.hpp"
#include "components/reference/tabulated.hpp"
#include "core/base/error.hpp"

namespace tushar::reference {

namespace {

struct TableSection : GasTags {
  std::string file;
};
const input::Schema<TableSection>& tableSchema() {
  static const input::Schema<TableSection> schema =
      gasSchema<TableSection>(
          "tabulated",
          "Errors relative to the cells of another run, with higher resolution, at the time and in the "
          "box of its output. Internal energy is a mass-weighted mean.")
          .required("file", &TableSection::file, "1",
                    "an output (.h5) with c.density, c.velocity and c.pressure, or a table that tools/coarsen made "
                    "from one; path relative to the scene")
          .ours();
  return schema;
}

}  // namespace

simulation::AnalysisKind tabulatedKind() {
  return gasModule("tabulated", "errors relative to the cells of another run", tableSchema,
                   [](const TableSection& read, const grid::Level&) {
                     try {
                       return std::make_shared<Tabulated>(readGasTable(read.file, read.gamma));
                     } catch (const FileError& error) {
                       throw std::invalid_argument(error.what());
                     }
                   });
}

}  // namespace tushar::reference
