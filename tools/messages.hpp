#pragma once

#include <string>

namespace tushar {

/// The code of a message of sus, such as `T101`, which never changes; empty if the message has none. A message belongs
/// to the family whose fixed words have the most letters in it. The families are in tools/manual_pages/messages, from
/// which a page of the manual is made, too.
std::string messageNumber(const std::string& message);

/// The message followed by its code: `unknown tag <x> in <Time> [T101]`.
std::string withNumber(const std::string& message);

}  // namespace tushar
