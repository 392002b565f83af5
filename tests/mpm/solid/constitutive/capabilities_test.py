#!/usr/bin/env python3
"""The model of the README compiles from one file and one line; a mistake in it gives a clear compiler error."""
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "support"))
from compiler import complaints
from sus import ROOT

FOLDER = pathlib.Path("components/mpm/solid/constitutive")
PAGE = (ROOT / FOLDER / "README.md").read_text()
MODEL, LINE = re.findall(r"```cpp\n(.*?)```", PAGE, re.S)

# name of the model: (text of the example: what stands there instead, sentence of the compiler)
SLIPS = {
    "Misspelt": ({" bulkSpeed(": " bulkspeed("},
                 "capability::BulkSpeed needs the public member `double bulkSpeed(double initialDensity, const "
                 "Deformation&, const Matrix3& stress, const State&) const`"),
    "WithoutConst": ({" bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const":
                      " bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&)"},
                     "capability::BulkSpeed needs the public member `double bulkSpeed("),
    "OtherArguments": ({" bulkSpeed(double initialDensity, const Deformation& d,":
                        " bulkSpeed(const Deformation& d, double initialDensity,"},
                       "capability::BulkSpeed needs the public member `double bulkSpeed("),
    "Hidden": ({"  double bulkSpeed(": " private:\n  double bulkSpeed(",
                "  double strainEnergyDensity(": " public:\n  double strainEnergyDensity("},
               "capability::BulkSpeed needs the public member `double bulkSpeed("),
    "Unnamed": ({", capability::BulkSpeed>": ">"},
                "the member `bulkSpeed` is used only if the model lists capability::BulkSpeed"),
    "UnnamedTemplate": ({"State initialState": "template <class Real> TensorOf<Real> kirchhoffStress(const "
                         "TensorOf<Real>& f) const { return f; }\n  State initialState"},
                        "the member `kirchhoffStress` is used only if the model lists capability::Vectorized"),
    "UnnamedPrivateData": ({" private:\n": " private:\n  MaterialConstants material;\n"},
                           "the member `material` is filled only if the model lists capability::ConstantsOfMaterial"),
    "HalfVectorized": ({"capability::BulkSpeed>": "capability::BulkSpeed, capability::Vectorized>",
                        "State initialState": "template <class Real> TensorOf<Real> kirchhoffStress(const "
                        "TensorOf<Real>& f) const { return f; }\n  template <class Real> Real strainEnergyDensity("
                        "const TensorOf<Real>&) const { return Real(); }\n  State initialState"},
                       "capability::Vectorized needs the public member `template <class Real> Real waveSpeed("),
    "HeatByValue": ({"capability::BulkSpeed>": "capability::BulkSpeed, capability::ViscousHeat>",
                     "State initialState": "void addViscousHeat(State, double) const {}\n  State initialState"},
                    "capability::ViscousHeat needs the public member `void addViscousHeat(State&, double heat) const`"),
    "MisspeltRequired": ({" waveSpeed(": " wavespeed("}, "a constitutive model needs `double waveSpeed("),
    "WithoutVariables": ({"struct State {};": "struct State { double alpha; };",
                          "<capability::DependsOnDeformationOnly, ": "<"},
                         "a State that is not empty needs `static constexpr std::array<StateVariable, N> "
                         "stateVariables`"),
    "TooFewVariables": ({"struct State {};": "struct State { double alpha, beta; };\n  static constexpr std::array"
                         "<StateVariable, 1> stateVariables{{{\"p.alpha\", \"1\", \"\"}}};",
                         "<capability::DependsOnDeformationOnly, ": "<"},
                        "stateVariables must name every double and every Tensor of the State"),
    "VariableOfNobody": ({"struct State {};": "struct State { double alpha; };\n  static constexpr std::array"
                          "<StateVariable, 1> stateVariables{{{\"alpha\", \"1\", \"\"}}};",
                          "<capability::DependsOnDeformationOnly, ": "<"},
                         "the names of stateVariables start with p."),
    "WithoutCapabilities": ({"using Capabilities": "using Capabilites"},
                            "a constitutive model needs `using Capabilities = CapabilityList<...>`"),
    "ForeignCapability": ({"capability::BulkSpeed>": "capability::BulkSpeed, std::array<int, 2>>"},
                          "Capabilities must list only capabilities of this kind of model"),
}

# A flow model whose optional member is misspelt.
FLOW = """
struct MisspeltFlow {
  using Capabilities = CapabilityList<capability::Hardening>;
  static constexpr std::string_view name = "flow";
  static const input::Schema<MisspeltFlow>& schema();
  double flowStress(const FlowState&) const { return 1; }
  double hardning(const FlowState&) const { return 0; }
};
static_assert(FlowRule<MisspeltFlow>);
"""
FLOW_SENTENCE = "capability::Hardening needs the public member `double hardening(const FlowState&) const`"


class Capabilities(unittest.TestCase):
    maxDiff = None

    def test_the_page_promises_no_file_that_is_not_there(self):
        self.assertFalse((ROOT / FOLDER / "blatz_ko.hpp").exists())
        self.assertRegex(PAGE, r"only an example: the folder does not contain it\. Saved as `blatz_ko\.hpp`")

    def test_a_model_is_one_file_and_one_line(self):
        table = (ROOT / FOLDER / "all.hpp").read_text()
        models = table.index("std::tuple<") + len("std::tuple<")
        headers = {FOLDER / "all.hpp": f'#include "{FOLDER}/blatz_ko.hpp"\n{table[:models]}{LINE}{table[models:]}',
                   FOLDER / "blatz_ko.hpp": MODEL}
        self.assertEqual(complaints(f"""
#include "{FOLDER}/all.hpp"
#include "{FOLDER}/model.hpp"
using namespace tushar::mpm::solid;
static_assert(std::is_same_v<std::tuple_element_t<0, AllModels>, BlatzKo>);
const ModelOf<BlatzKo> model{{BlatzKo()}};
""", headers), "")

    def test_a_slip_is_refused_with_a_sentence(self):
        includes = "\n".join(line for line in MODEL.splitlines() if line.startswith("#include"))
        body = MODEL[MODEL.index("namespace"):]
        text = f'{includes}\n#include "{FOLDER}/plasticity/flow_rule.hpp"\n'
        for name, (changes, _) in SLIPS.items():
            changed = body
            for before, after in changes.items():
                self.assertIn(before, body)
                changed = changed.replace(before, after)
            text += "\n" + changed.replace("BlatzKo", name)
        text += "namespace tushar::mpm::solid {" + FLOW + "}"
        said = complaints(text)
        expected = {name: sentence for name, (_, sentence) in SLIPS.items()} | {"MisspeltFlow": FLOW_SENTENCE}
        self.assertEqual(self.sentences(said).keys(), expected.keys(), said)
        for name, sentence in expected.items():
            with self.subTest(name):
                self.assertEqual(len(self.sentences(said)[name]), 1, said)
                self.assertIn(sentence, self.sentences(said)[name][0])

    def test_a_capability_that_does_not_exist_is_refused(self):
        changed = MODEL.replace("#pragma once", "").replace("capability::BulkSpeed", "capability::BulkSped")
        said = complaints(changed)
        self.assertIn("BulkSped", said)

    @staticmethod
    def sentences(said):
        """Returns the failed assertions of each model, for functions that are instantiated for it."""
        found, model = {}, None
        for line in said.splitlines():
            if instantiated := re.search(r"In instantiation of .*\[with (?:M|T|Flow) = (?:\w+::)*(\w+)[;\]]", line):
                model = instantiated[1]
            if sentence := re.search(r"error: static assertion failed: (.*)", line):
                found.setdefault(model, []).append(sentence[1])
        return found


if __name__ == "__main__":
    unittest.main()
