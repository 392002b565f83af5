#include "core/simulation/plain_module.hpp"

#include <stdexcept>
#include <utility>

#include "core/base/error.hpp"
#include "core/input/schema.hpp"

namespace tushar::simulation {

namespace {

struct Tags {
  std::string name;
};

MakeAnalysis blaming(const input::Element& module, const MakeAnalysis& make) {
  return [where = module.where(), path = module.path(), make](const Component& component, const grid::Level& level) {
    try {
      return make(component, level);
    } catch (const std::invalid_argument& error) {
      throw InputError({{where, path, error.what()}});
    }
  };
}

}  // namespace

AnalysisKind plainModule(std::string name, std::string sentence, std::string_view manual, MakeAnalysis make) {
  const auto schema = std::make_shared<input::Schema<Tags>>("Module", manual);
  schema->requiredAttribute("name", &Tags::name, "1", name);
  return {std::move(name), std::move(sentence),
          [schema, make = std::move(make)](const input::Element& module, input::Diagnostics& diagnostics) {
            schema->read(module, diagnostics);
            return blaming(module, make);
          },
          [schema](std::ostream& out) { schema->describe(out); }, [schema] { return schema.get(); }};
}

}  // namespace tushar::simulation
