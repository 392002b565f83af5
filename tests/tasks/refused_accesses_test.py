#!/usr/bin/env python3
"""Invalid arguments of a task do not compile, and the compiler's message gives the reason."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from compiler import complaints

START = """
#include "core/tasks/marks.hpp"
#include "core/tasks/task_list.hpp"
using namespace tushar;
using namespace tushar::tasks;
constexpr data::CellLabel<double> density{"c.density", "kg/m^3", "density"}, other{"c.other", "1", "another"};
constexpr data::ParticleLabel<double> mass{"p.mass", "kg", "mass"};
constexpr data::ReductionLabel<data::Sum> total{"total", "1", "sum"};
struct Material { std::string name; };
struct Group {
  data::CellView<const double> density;
  data::CellView<double> other;
  static Group from(auto& take) { return {%s}; }
};
struct Totals {
  data::Sum& total;
  static Totals from(auto& take) { return {.total = take(computes(::total))}; }
};
struct Mixed {
  data::Sum& total;
  data::CellView<const double> density;
  static Mixed from(auto& take) {
    return {.total = take(computes(::total)), .density = take(requiresNew(::density))};
  }
};
struct Particles {
  data::ParticleView<const double> mass;
  static Particles from(auto& take) { return {.mass = take(requiresNew(::mass))}; }
};
struct Made {
  std::vector<double>& mass;
  static Made from(auto& take) { return {.mass = take(creates(::mass))}; }
};
void task(TaskList& list, const std::vector<Material>& materials) {
  const auto body = [](const auto&...) {};
  list.perPatch("read", [](const grid::Patch& patch, const Group& group) {
    grid::forEach<1>(patch.cells(), [&](const Index<1>& cell) { %s; });
  }, all<Group>());
  %s;
  (void)body; (void)materials;
}
"""


def piece(members=".density = take(requiresNew(::density)), .other = take(computes(::other))",
          use="group.other[cell] = group.density[cell]", task=""):
    """Returns a task list that compiles except for the parts given."""
    return START % (members, use, task)


class RefusedAccesses(unittest.TestCase):
    def test_what_is_right_compiles(self):
        self.assertEqual(complaints(piece()), "")

    def test_an_optional_reducer_is_refused(self):
        said = complaints(piece(task='list.perPatch("sum", body, when(true, computes(total)))'))
        self.assertIn("a reducer or a list of new values cannot be optional", said)

    def test_what_belongs_to_no_material_is_left_out_of_tasks_of_materials_alone(self):
        said = complaints(piece(task='list.perPatch("read", body, withoutMaterial(requiresNew(::density)))'))
        self.assertIn("withoutMaterial(...) is not needed in perPatch, whose tasks have no materials", said)
        said = complaints(piece(task='list.perRank("read", body, withoutMaterial(requiresNew(::density)))'))
        self.assertIn("withoutMaterial(...) is allowed only in perMaterial and acrossMaterials", said)
        said = complaints(piece(task='list.newParticles("make", body, materials, withoutMaterial(computes(::other)))'))
        self.assertIn("withoutMaterial(...) is allowed only in perMaterial and acrossMaterials", said)

    def test_new_particles_belong_to_the_task_that_makes_them(self):
        said = complaints(piece(task='list.perMaterial("make", body, materials, creates(mass))'))
        self.assertIn("creates(...) is allowed only in newParticles", said)

    def test_a_group_makes_no_particles_elsewhere(self):
        code = piece(task='list.perMaterial("make", body, materials, all<Made>())')
        self.assertIn("creates(...) is allowed only in newParticles, even in a group", complaints(code))
        self.assertEqual(complaints(code.replace("perMaterial", "newParticles")), "")

    def test_a_group_takes_no_plain_value(self):
        for value in ("with(1.0)", "startTime()"):
            members = f".density = take(requiresNew(::density)), .other = (take({value}), take(computes(::other)))"
            self.assertIn("take(...) accepts only accesses to labels", complaints(piece(members=members)))

    def test_totals_are_reductions(self):
        code = piece(task='list.acrossMaterials("sum", body, materials, totals<Mixed>())')
        self.assertIn("totals<Group>() accepts only reductions", complaints(code))
        self.assertEqual(complaints(code.replace("totals<Mixed>", "totals<Totals>")), "")

    def test_particles_belong_to_a_material(self):
        tasks = [f'perPatch("read", body, {argument})'
                 for argument in ("computes(mass)", "all<Particles>()", "when(true, requiresOld(mass))")]
        tasks.append('perRank("read", body, requiresNew(mass))')
        tasks.append('perMaterial("read", body, materials, withoutMaterial(requiresNew(mass)))')
        for task in tasks:
            self.assertIn("a variable of particles belongs to a material", complaints(piece(task="list." + task)), task)
        said = complaints(piece(task='list.perMaterial("make", body, materials, withoutMaterial(creates(mass)))'))
        self.assertIn("creates(...) is allowed only in newParticles", said)

    def test_marks_and_new_cells_are_those_of_a_patch(self):
        for task in ("perMaterial", "acrossMaterials"):
            self.assertIn("marks() is allowed only in perPatch",
                          complaints(piece(task=f'list.{task}("mark", body, materials, marks())')))
        said = complaints(piece(task='list.perRank("mark", body, marks())'))
        self.assertIn("marks() is allowed only in perPatch", said)
        self.assertIn("newCells() and besideFiner() are allowed only in tasks of a patch",
                      complaints(piece(task='list.perRank("refine", body, newCells())')))
        self.assertEqual(complaints(piece(task='list.acrossMaterials("refine", body, materials, newCells())')), "")

    def test_ranks_belong_to_tasks_of_a_rank(self):
        said = complaints(piece(task='list.perPatch("solve", body, togetherOnRanks())'))
        self.assertIn("togetherOnRanks() and withWorkers() are allowed only in perRank", said)

    def test_a_group_writes_nothing_that_it_reads(self):
        self.assertIn("read-only", complaints(piece(use="group.density[cell] = 1")))

    def test_a_group_touches_nothing_that_it_does_not_declare(self):
        self.assertIn("no member named 'mass'",
                      complaints(piece(use="(void)group.mass")).replace("\u2018", "'").replace("\u2019", "'"))

    def test_a_group_forgets_no_member(self):
        self.assertNotEqual(complaints(piece(members=".density = take(requiresNew(::density))")), "")

    def test_a_member_is_what_its_label_is(self):
        members = ".density = take(requiresNew(mass)), .other = take(computes(::other))"
        self.assertNotEqual(complaints(piece(members=members)), "")


if __name__ == "__main__":
    unittest.main()
