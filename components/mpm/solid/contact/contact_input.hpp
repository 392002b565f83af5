#pragma once

#include "components/mpm/solid/contact/contact.hpp"
#include "core/input/diagnostics.hpp"
#include "core/input/element.hpp"
#include "core/input/tag_form.hpp"

namespace tushar::mpm::solid {

/// The `contact` tags among the children of `parent`; those of type null are left out.
std::vector<Contact> readContacts(const input::Element& parent, input::Diagnostics& diagnostics);

/// Prints the manual of these tags, indented by `indent` blanks.
void describeContacts(std::ostream& out, int indent);
/// The allowed content of such a tag, for the schemas of editors.
input::TagForm contactForm();

}  // namespace tushar::mpm::solid
