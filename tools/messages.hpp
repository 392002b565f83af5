#pragma once

#include <string>

namespace tushar {

/// The code of a message of sus, such as `T101`, which never changes; empty if the message has none. It belongs to the
/// family with the most letters of fixed words in the message. tools/manual_pages/messages lists the families, from
/// which the manual makes a page, too.
std::string messageNumber(const std::string& message);

/// The message followed by its code: `unknown tag <x> in <Time> [T101]`.
std::string withNumber(const std::string& message);

}  // namespace tushar
