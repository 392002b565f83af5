#include "components/mpm/solid/contact/contact_input.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

using input::Diagnostics;
using input::Element;
using input::Schema;

namespace {

enum class Kind { none, singleVelocity, rigid, specified };

/// The tags of every kind of contact, as they are written.
struct ContactSection {
  Kind kind = Kind::none;
  std::optional<std::vector<int>> materials;
  Index3 direction{{0, 0, 1}};
  int master = 0;
  double stopTime = 0;
  Vec3 velocityAfterStop = Vec3::Zero();
  std::string profileFile;
};

const Schema<ContactSection>& contactSchema() {
  static const Schema<ContactSection> schema =
      Schema<ContactSection>("contact", "How materials act on each other where they share nodes.")
          .requiredChoice("type", &ContactSection::kind,
                          {{"null", Kind::none},
                           {"single_velocity", Kind::singleVelocity},
                           {"rigid", Kind::rigid},
                           {"specified", Kind::specified}},
                          "not at all; as one body; or they follow a master, which is free or moves as told")
          .optional("materials", &ContactSection::materials, "1", "numbers of the materials that take part; else all")
          .value("direction", &ContactSection::direction, Index3{{0, 0, 1}}, "1",
                 "rigid, specified: 1 along x, y, z where the others follow the master", input::between(0, 1))
          .value("master_material", &ContactSection::master, 0, "1", "rigid, specified: number of the master",
                 input::nonNegative())
          .value("stop_time", &ContactSection::stopTime, std::numeric_limits<double>::max(), "s",
                 "rigid, specified: from then on all move with velocity_after_stop")
          .value("velocity_after_stop", &ContactSection::velocityAfterStop, Vec3::Zero(), "m/s",
                 "rigid, specified: velocity after stop_time")
          .value("filename", &ContactSection::profileFile, "", "1",
                 "specified: a file with a line `time vx vy vz` for each of at least two times, ascending")
          .ignored("vel_fields", "an old word for materials")
          .ignored("do_contact_friction_heating", "rubbing makes no heat here");
  return schema;
}

/// The lines `time vx vy vz` of a file that stands beside the scene.
std::vector<std::pair<double, Vec3>> readProfile(const Element& tag, const std::string& name, Diagnostics& diagnostics) {
  const auto path = std::filesystem::path(tag.where().file).parent_path() / name;
  std::ifstream file(path);
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
  contact.type = follows ? Contact::Type::specified : Contact::Type::singleVelocity;
  contact.materials = read.materials.value_or(std::vector<int>{});
  contact.master = read.master;
  for (int axis = 0; axis < 3; ++axis) contact.direction[static_cast<std::size_t>(axis)] = read.direction[axis] != 0;
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

void describeContacts(std::ostream& out, int indent) { contactSchema().describeContents(out, indent); }

}  // namespace tushar::mpm::solid
