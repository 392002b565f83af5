#pragma once

#include "components/mpm/solid/contact/contact.hpp"
#include "core/input/diagnostics.hpp"
#include "core/input/element.hpp"
#include "core/input/tag_form.hpp"

namespace tushar::mpm::solid {

/// Reads the `contact` tags among the children of `parent`; those of type null are omitted.
std::vector<Contact> readContacts(const input::Element& parent, input::Diagnostics& diagnostics);

/// Prints the manual of the `contact` tags, indented by `indent` blanks.
void describeContacts(std::ostream& out, int indent);
/// The allowed content of a `contact` tag, for the schemas of editors.
input::TagForm contactForm();

}  // namespace tushar::mpm::solid
