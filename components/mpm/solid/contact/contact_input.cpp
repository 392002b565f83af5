#include "components/mpm/solid/contact/contact_input.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "components/mpm/solid/number_lines.hpp"
#include "core/input/refuse.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

enum class Kind {
  none,
  singleVelocity,
  rigid,
  specified,
  friction,
  conservingFriction,
  approach,
  planeFriction,
  colorFriction,
  specifiedFriction,
};

const input::Choices<Kind> kinds{{"null", Kind::none},
                                 {"single_velocity", Kind::singleVelocity},
                                 {"rigid", Kind::rigid},
                                 {"specified", Kind::specified},
                                 {"specified_velocity", Kind::specified},
                                 {"friction", Kind::friction},
                                 {"friction_bard", Kind::friction},
                                 {"friction_conserving", Kind::conservingFriction},
                                 {"approach", Kind::approach},
                                 {"friction_LR", Kind::planeFriction},
                                 {"friction_LRVar", Kind::colorFriction},
                                 {"specified_friction", Kind::specifiedFriction}};
const input::Lacking lackingKinds{
    {"penalty", "friction_bard"}, {"nodal_svf", "single_velocity"}, {"fluid", "single_velocity"}};

/// Whether bodies slide and separate.
bool slides(Kind kind) { return kind == Kind::friction || kind == Kind::conservingFriction || kind == Kind::approach; }

/// Whether bodies slide along the planes that separate their particles.
bool usesPlanes(Kind kind) {
  return kind == Kind::planeFriction || kind == Kind::colorFriction || kind == Kind::specifiedFriction;
}
/// Whether the other bodies follow or meet a master that may be driven.
bool hasMaster(Kind kind) { return kind == Kind::rigid || kind == Kind::specified || kind == Kind::specifiedFriction; }

/// A tag `entry` of variable_friction.
struct FrictionEntry {
  double color = 0, friction = 0;
};
struct FrictionTable {
  std::vector<FrictionEntry> entries;
};

/// The tags of all kinds of contact, as given in the scene.
struct ContactSection {
  Kind kind = Kind::none;
  std::optional<std::vector<int>> materials;
  std::optional<Index3> direction;
  int master = 0;
  double stopTime = 0;
  Vec3 velocityAfterStop = Vec3::Zero();
  std::string profileFile;
  std::optional<double> friction;
  double separationFactor = 0, volumeConstraint = 0;
  std::optional<int> steps, excluded;
  bool turns = false;
  std::optional<FrictionTable> frictionTable;
};

const Schema<FrictionTable>& frictionTableSchema() {
  static const Schema<FrictionEntry> entry =
      Schema<FrictionEntry>("entry", "The coefficient of friction at a color.")
          .required("color", &FrictionEntry::color, "1", "p.color of the master")
          .required("mu", &FrictionEntry::friction, "1", "coefficient there", input::nonNegative());
  static const Schema<FrictionTable> schema =
      Schema<FrictionTable>("variable_friction",
                            "The coefficient of friction as a function of the color of the master.")
          .list("entry", &FrictionTable::entries, entry,
                "in order of increasing color; linear between entries, constant outside their range", 2)
          .check([](const FrictionTable& table, const Element& element, Diagnostics& diagnostics) {
            input::refuseDescent(table.entries, &FrictionEntry::color, element.children("entry"),
                                 "its color is not above that of the previous entry", diagnostics);
          });
  return schema;
}

/// Checks the tags of contacts along planes.
void checkPlanes(const ContactSection& read, const Element& element, Diagnostics& diagnostics) {
  const bool byColor = read.kind == Kind::colorFriction;
  if (byColor && !read.frictionTable)
    diagnostics.error(element, "missing tag <variable_friction> in <contact>: friction_LRVar takes mu from this table");
  if (byColor && !element.child("master_material"))
    diagnostics.error(
        element, "missing tag <master_material> in <contact>: friction_LRVar takes mu from the color of this material");
  if (!byColor && read.frictionTable)
    diagnostics.error(element.child("variable_friction").value(), "applies only to contacts of type friction_LRVar");
  if (usesPlanes(read.kind) && !byColor && !read.friction)
    diagnostics.error(element, "missing tag <mu> in <contact>: friction needs a coefficient");
  if (usesPlanes(read.kind) && read.kind != Kind::specifiedFriction && read.excluded)
    diagnostics.error(element.child("ExcludeMaterial").value(),
                      "applies only to contacts of type rigid, specified, specified_friction and single_velocity");
}

void checkContact(const ContactSection& read, const Element& element, Diagnostics& diagnostics) {
  if (slides(read.kind) && !read.friction)
    diagnostics.error(element, "missing tag <mu> in <contact>: friction needs a coefficient");
  if (slides(read.kind) && read.excluded)
    diagnostics.error(element.child("ExcludeMaterial").value(),
                      "applies only to contacts of type rigid, specified and single_velocity");
  if (!slides(read.kind) && !usesPlanes(read.kind) && read.volumeConstraint > 0)
    diagnostics.error(element.child("volume_constraint").value(),
                      "applies only to contacts of type friction, friction_bard, friction_conserving and approach");
  if (read.turns && (!hasMaster(read.kind) || read.profileFile.empty()))
    diagnostics.error(element.child("include_rotation").value(),
                      "needs a contact of type rigid, specified or specified_friction and its <filename>");
  checkPlanes(read, element, diagnostics);
}

/// Declares the kinds of contact and the tag for the materials that take part.
void addKinds(Schema<ContactSection>& contact) {
  requiredChoiceOrRefusal(
      contact, "type", &ContactSection::kind, kinds, lackingKinds,
      "null: no contact. single_velocity: all move as one body. rigid: all follow a master, on which no stress acts. "
      "specified, specified_velocity (synonyms): all follow a master with prescribed motion. friction, friction_bard "
      "(synonyms): bodies separate freely and slide with friction, as in Uintah, which tests the pressure of each body "
      "separately. friction_conserving: the same, but bodies share one normal and are in contact only if the stresses "
      "of all of them are compressive, which conserves momentum. approach: as friction, but only while bodies approach "
      "each other; so do friction, friction_bard and friction_conserving in a gas. friction_LR: bodies separate "
      "freely, conserve momentum and slide with friction along the plane that "
      "separates their particles, found by logistic regression (Nairn, Hammerquist & Smith 2020). friction_LRVar: the "
      "same, with mu as a function of the color of the master. specified_friction: bodies separate from a master with "
      "prescribed motion, and slide on it along such planes");
  contact
      .optional("materials", &ContactSection::materials, "1", "indices of the materials that take part; all by default")
      .optional("OneOrTwoStep", &ContactSection::steps, "1",
                "1: acts only on the velocities at the end of a step; 2: also on those at its start. By default 1 for "
                "rigid and specified, otherwise 2; with XPIC2 always 2",
                input::between(1, 2))
      .optional("ExcludeMaterial", &ContactSection::excluded, "1",
                "for rigid, specified, single_velocity: does not act at nodes with this material", input::nonNegative())
      .ignored("vel_fields", "an older name of <materials>");
}

/// Declares the motion of the master, for contacts that have one.
void addMaster(Schema<ContactSection>& contact) {
  contact
      .optional("direction", &ContactSection::direction, "1",
                "for rigid, specified: 1 for each of x, y, z along which the others follow the master. By default "
                "along z, in implicit steps along all",
                input::between(0, 1))
      .value("master_material", &ContactSection::master, 0, "1", "for rigid, specified: index of the master",
             input::nonNegative())
      .value("stop_time", &ContactSection::stopTime, std::numeric_limits<double>::max(), "s",
             "for rigid, specified: time from which all bodies move with velocity_after_stop")
      .value("velocity_after_stop", &ContactSection::velocityAfterStop, Vec3::Zero(), "m/s",
             "for rigid, specified: velocity after stop_time")
      .value("filename", &ContactSection::profileFile, "", "1",
             "for specified: a file with lines `time vx vy vz` for at least two ascending times")
      .value("include_rotation", &ContactSection::turns, false, "1",
             "for specified: the master also rotates; each line of <filename> is `time vx vy vz cx cy cz wx wy wz`, "
             "where c is a point on the axis (m) and w the angular velocity (1/s)")
      .ignored("rigid_material", "an older name of <master_material>");
}

void addFriction(Schema<ContactSection>& contact) {
  contact
      .optional("mu", &ContactSection::friction, "1",
                "coefficient of friction; required for approach and for all types with friction except friction_LRVar",
                input::nonNegative())
      .section("variable_friction", &ContactSection::frictionTable, frictionTableSchema())
      .value("separation_factor", &ContactSection::separationFactor, 9.9e99, "1",
             "for friction, friction_bard, friction_conserving and approach: distance in cells beyond which bodies do "
             "not touch",
             input::positive())
      .value("volume_constraint", &ContactSection::volumeConstraint, 0, "1",
             "for friction, friction_bard, friction_conserving and approach: fraction of the volume around a node that "
             "bodies must fill to touch there",
             input::nonNegative());
}

const Schema<ContactSection>& contactSchema() {
  static const Schema<ContactSection> schema = [] {
    Schema<ContactSection> contact("contact", "How materials interact where they share nodes.");
    addKinds(contact);
    addMaster(contact);
    addFriction(contact);
    contact.check(checkContact);
    refuseSwitch(contact, "normal_only", "use friction_bard with mu 0");
    for (const char* tag : {"condition", "conditionValue", "conditionAction"})
      refuseTag(contact, tag, "give the motion over time in <filename>");
    return contact;
  }();
  return schema;
}

/// Reads the numbers in a file next to the scene, `columns` per line.
std::vector<double> readTable(const Element& tag, const std::string& path, std::size_t columns,
                              Diagnostics& diagnostics) {
  std::ifstream file(path);
  if (!file) {
    diagnostics.error(tag, fmt::format("filename: '{}' cannot be read: there is no such file", path));
    return {};
  }
  std::vector<double> numbers;
  std::string line;
  for (int at = 1; std::getline(file, line); ++at) {
    const Location where{path, at, 0};
    const auto read = numbersInLine(line, where, diagnostics);
    if (!read || read->empty()) continue;
    numbers.insert(numbers.end(), read->begin(), read->end());
    if (read->size() == columns) continue;
    diagnostics.error(
        where, {},
        columns == 4
            ? fmt::format("found {} numbers, expected 4: time, velocity", read->size())
            : fmt::format("found {} numbers, expected 10: time, velocity, centre and angular velocity", read->size()));
  }
  return numbers;
}

/// Reads the motion of a contact's master from a file.
void readMotion(const Element& tag, const ContactSection& read, Contact& contact, Diagnostics& diagnostics) {
  const std::string path = (std::filesystem::path(tag.where().file).parent_path() / read.profileFile).string();
  const std::size_t columns = read.turns ? 10 : 4;
  const std::size_t before = diagnostics.size();
  const std::vector<double> numbers = readTable(tag, path, columns, diagnostics);
  if (diagnostics.size() > before) return;
  for (std::size_t k = 0; k + columns <= numbers.size(); k += columns) {
    const double t = numbers[k];
    const auto vector = [&](std::size_t first) {
      return Vec3(numbers[k + first], numbers[k + first + 1], numbers[k + first + 2]);
    };
    if (!contact.profile.empty() && t <= contact.profile.back().first)
      diagnostics.error(tag, fmt::format("filename: the times in '{}' do not increase at {:g} s", path, t));
    contact.profile.emplace_back(t, vector(1));
    if (!read.turns) continue;
    contact.centres.emplace_back(t, vector(4));
    contact.angularVelocity.emplace_back(t, vector(7));
  }
  if (contact.profile.size() < 2)
    diagnostics.error(tag, fmt::format("filename: '{}' has fewer than two lines `time vx vy vz`", path));
}

Contact::Type typeOf(Kind kind) {
  if (kind == Kind::rigid || kind == Kind::specified) return Contact::Type::specified;
  if (kind == Kind::specifiedFriction) return Contact::Type::specifiedFriction;
  if (usesPlanes(kind)) return Contact::Type::planeFriction;
  return slides(kind) ? Contact::Type::friction : Contact::Type::singleVelocity;
}

/// Adds notes on the materials that take part in a contact, of `count` in the scene: on those that do not exist, and if
/// less than two are left, or if those that follow a master are not listed.
void noteMaterials(const ContactSection& read, const Element& tag, int count, Diagnostics& diagnostics) {
  if (count < 2) return;
  if (hasMaster(read.kind) && !read.materials)
    diagnostics.note(
        tag,
        "without <materials>, all materials follow the master; in Uintah, none does: there, bodies move as "
        "if there were no contact");
  if (!read.materials) return;
  std::set<int> taking, missing;
  if (hasMaster(read.kind)) taking.insert(read.master);
  for (const int number : *read.materials) (number >= 0 && number < count ? taking : missing).insert(number);
  const Element listed = tag.child("materials").value();
  if (!missing.empty())
    diagnostics.note(
        listed, fmt::format("there is no material {}{}; materials are numbered from 0 to {}", *missing.begin(),
                            missing.size() == 1 ? "" : fmt::format(", and {} more", missing.size() - 1), count - 1));
  if (taking.size() < 2) diagnostics.note(listed, "lists less than two materials, so that this contact has no effect");
}

Contact settle(const ContactSection& read, const Element& tag, Diagnostics& diagnostics) {
  Contact contact;
  contact.type = typeOf(read.kind);
  contact.where = tag.where();
  contact.actsTwice = read.steps.value_or(hasMaster(read.kind) ? 1 : 2) == 2;
  contact.excluded = read.excluded.value_or(-1);
  contact.friction = read.friction.value_or(0);
  if (read.frictionTable)
    for (const FrictionEntry& entry : read.frictionTable->entries)
      contact.frictionOfColor.emplace_back(entry.color, entry.friction);
  contact.onlyOnApproach = read.kind == Kind::approach;
  contact.keepsMomentum = read.kind == Kind::conservingFriction;
  contact.separationFactor = read.separationFactor;
  contact.volumeConstraint = read.volumeConstraint;
  contact.materials = read.materials.value_or(std::vector<int>{});
  contact.master = read.master;
  contact.directionIsGiven = read.direction.has_value();
  for (int axis = 0; axis < 3 && read.direction; ++axis) contact.direction[axis] = (*read.direction)[axis] != 0;
  contact.stopTime = read.stopTime;
  contact.velocityAfterStop = read.velocityAfterStop;
  if (!read.profileFile.empty()) readMotion(tag, read, contact, diagnostics);
  return contact;
}

}  // namespace

std::vector<Contact> readContacts(const Element& parent, Diagnostics& diagnostics) {
  std::vector<Contact> contacts;
  for (const Element& tag : parent.children("contact")) {
    const ContactSection read = contactSchema().read(tag, diagnostics);
    if (read.kind == Kind::none) continue;
    noteMaterials(read, tag, static_cast<int>(parent.children("material").size()), diagnostics);
    contacts.push_back(settle(read, tag, diagnostics));
  }
  return contacts;
}

input::TagForm contactForm() {
  return input::sectionForm({"contact"}, [] { return std::vector<input::Alternative>{{&contactSchema(), {}}}; });
}

void describeContacts(std::ostream& out, int indent) { contactSchema().describeContents(out, indent); }

}  // namespace tushar::mpm::solid
