#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tushar::input {

/// The largest allowed depth of nested tags.
inline constexpr std::size_t mostNested = 100;

/// The first place in an XML text at which tags are not properly nested.
struct BadNesting {
  std::ptrdiff_t where;            ///< byte in the text
  std::string closed;              ///< name of the tag that is closed there; empty at the end of the text
  std::string open;                ///< name of the innermost tag that is open there; empty if none is
  std::ptrdiff_t whereOpened = 0;  ///< byte at which its name starts
  bool wasOpened = false;          ///< whether the tag that is closed is open further out
  bool tooDeep = false;            ///< whether the only problem is that tags are nested too deep
};

/// Checks only tags: comments, CDATA, declarations and text between tags are skipped.
std::optional<BadNesting> findBadNesting(std::string_view text);

}  // namespace tushar::input
