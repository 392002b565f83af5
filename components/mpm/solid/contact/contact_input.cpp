#include "components/mpm/solid/contact/contact_input.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "core/input/refuse.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

enum class Kind { none, singleVelocity, rigid, specified, friction, conservingFriction, approach };

const input::Choices<Kind> kinds{{"null", Kind::none},
                                 {"single_velocity", Kind::singleVelocity},
                                 {"rigid", Kind::rigid},
                                 {"specified", Kind::specified},
                                 {"specified_velocity", Kind::specified},
                                 {"friction", Kind::friction},
                                 {"friction_bard", Kind::friction},
                                 {"friction_conserving", Kind::conservingFriction},
                                 {"approach", Kind::approach}};
const input::Lacking lackingKinds{{"friction_LR", "friction_bard"},
                                  {"friction_LRVar", "friction_bard"},
                                  {"specified_friction", "specified, where nothing slips"},
                                  {"penalty", "friction_bard"},
                                  {"nodal_svf", "single_velocity"},
                                  {"fluid", "single_velocity"}};

/// Whether bodies slide and part.
bool slides(Kind kind) { return kind == Kind::friction || kind == Kind::conservingFriction || kind == Kind::approach; }

/// The tags of every kind of contact, as they are written.
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
};

void checkContact(const ContactSection& read, const Element& element, Diagnostics& diagnostics) {
  if (slides(read.kind) && !read.friction)
    diagnostics.error(element, "missing tag <mu> in <contact>: friction needs its coefficient");
  if (slides(read.kind) && read.excluded)
    diagnostics.error(element.child("ExcludeMaterial").value(),
                      "acts in contacts of type rigid, specified and single_velocity only");
  if (!slides(read.kind) && read.volumeConstraint > 0)
    diagnostics.error(element.child("volume_constraint").value(),
                      "acts in contacts of type friction, friction_bard, friction_conserving and approach only");
}

const Schema<ContactSection>& contactSchema() {
  static const Schema<ContactSection> schema = [] {
    Schema<ContactSection> contact("contact", "How materials act on each other where they share nodes.");
    requiredChoiceOrRefusal(
        contact, "type", &ContactSection::kind, kinds, lackingKinds,
        "not at all; as one body; they follow a master, which is free or moves as told (two words for it); they part "
        "freely and slide with friction as in Uintah, which asks each body alone whether its stress presses (two words "
        "for it); "
        "the same, but all have one normal and are pressed where the stresses of all press, which keeps momentum; as "
        "in "
        "Uintah, but only while they approach each other");
    contact.optional("materials", &ContactSection::materials, "1", "numbers of the materials that take part; else all")
        .optional(
            "direction", &ContactSection::direction, "1",
            "rigid, specified: 1 along x, y, z where the others follow the master. Left out: along z, in implicit "
            "steps along all",
            input::between(0, 1))
        .value("master_material", &ContactSection::master, 0, "1", "rigid, specified: number of the master",
               input::nonNegative())
        .value("stop_time", &ContactSection::stopTime, std::numeric_limits<double>::max(), "s",
               "rigid, specified: from then on all move with velocity_after_stop")
        .value("velocity_after_stop", &ContactSection::velocityAfterStop, Vec3::Zero(), "m/s",
               "rigid, specified: velocity after stop_time")
        .value("filename", &ContactSection::profileFile, "", "1",
               "specified: a file with a line `time vx vy vz` for each of at least two times, ascending")
        .optional("mu", &ContactSection::friction, "1", "friction, approach: coefficient; needed there",
                  input::nonNegative())
        .value("separation_factor", &ContactSection::separationFactor, 9.9e99, "1",
               "friction, approach: what lies farther apart than so many cells does not touch", input::positive())
        .value("volume_constraint", &ContactSection::volumeConstraint, 0, "1",
               "friction, approach: share of the volume around a node that bodies must fill to touch there",
               input::nonNegative())
        .optional(
            "OneOrTwoStep", &ContactSection::steps, "1",
            "1: acts on the velocities at the end of a step only; 2: on those at its start, too. Left out: 1 with "
            "rigid and specified, else 2; with XPIC2 always 2",
            input::between(1, 2))
        .optional("ExcludeMaterial", &ContactSection::excluded, "1",
                  "rigid, specified, single_velocity: does not act where this material is", input::nonNegative())
        .ignored("vel_fields", "an old word for materials")
        .ignored("rigid_material", "an old word for master_material")
        .check(checkContact);
    refuseSwitch(contact, "normal_only", "friction_bard with mu 0 lets bodies slip");
    refuseSwitch(contact, "include_rotation", "the master moves without turning");
    refuseTag(contact, "condition", "give the times of a profile by <filename>");
    refuseTag(contact, "conditionValue", "give the times of a profile by <filename>");
    refuseTag(contact, "conditionAction", "give the times of a profile by <filename>");
    refuseTag(contact, "variable_friction", "there is one <mu> for a contact");
    return contact;
  }();
  return schema;
}

/// The lines `time vx vy vz` of a file that stands beside the scene.
std::vector<std::pair<double, Vec3>> readProfile(const Element& tag, const std::string& name,
                                                 Diagnostics& diagnostics) {
  const auto path = std::filesystem::path(tag.where().file).parent_path() / name;
  std::ifstream file(path);
  if (!file) {
    diagnostics.error(tag, fmt::format("filename: '{}' cannot be read: there is no such file", path.string()));
    return {};
  }
  std::vector<std::pair<double, Vec3>> profile;
  double t;
  Vec3 v;
  while (file >> t >> v[0] >> v[1] >> v[2]) {
    if (!profile.empty() && t <= profile.back().first)
      diagnostics.error(tag, fmt::format("filename: the times in '{}' do not ascend at {:g} s", path.string(), t));
    profile.emplace_back(t, v);
  }
  if (profile.size() < 2)
    diagnostics.error(tag, fmt::format("filename: '{}' has no two lines `time vx vy vz`", path.string()));
  return profile;
}

Contact settle(const ContactSection& read, const Element& tag, Diagnostics& diagnostics) {
  Contact contact;
  const bool follows = read.kind == Kind::rigid || read.kind == Kind::specified;
  contact.type = follows             ? Contact::Type::specified
                 : slides(read.kind) ? Contact::Type::friction
                                     : Contact::Type::singleVelocity;
  contact.actsTwice = read.steps.value_or(follows ? 1 : 2) == 2;
  contact.excluded = read.excluded.value_or(-1);
  contact.friction = read.friction.value_or(0);
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
  if (!read.profileFile.empty()) contact.profile = readProfile(tag, read.profileFile, diagnostics);
  return contact;
}

}  // namespace

std::vector<Contact> readContacts(const Element& parent, Diagnostics& diagnostics) {
  std::vector<Contact> contacts;
  for (const Element& tag : parent.children("contact")) {
    const ContactSection read = contactSchema().read(tag, diagnostics);
    if (read.kind != Kind::none) contacts.push_back(settle(read, tag, diagnostics));
  }
  return contacts;
}

input::TagForm contactForm() {
  return input::sectionForm({"contact"}, [] { return std::vector<input::Alternative>{{&contactSchema(), {}}}; });
}

void describeContacts(std::ostream& out, int indent) { contactSchema().describeContents(out, indent); }

}  // namespace tushar::mpm::solid
