#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tushar::input {

/// The largest allowed nesting depth of tags.
inline constexpr std::size_t mostNested = 100;

/// The first place in an XML text at which tags are not properly nested.
struct BadNesting {
  std::ptrdiff_t where;            ///< position in the text [bytes]
  std::string closed;              ///< name of the tag that is closed there; empty at the end of the text
  std::string open;                ///< name of the innermost open tag at this place; empty if no tag is open
  std::ptrdiff_t whereOpened = 0;  ///< position at which the name of the innermost open tag starts [bytes]
  bool wasOpened = false;          ///< whether `closed` is the name of an open tag further out
  bool tooDeep = false;            ///< whether the only problem is that tags are nested too deeply
};

/// Finds the first nesting error. Checks only tags: comments, CDATA, declarations and text between tags are skipped.
std::optional<BadNesting> findBadNesting(std::string_view text);

/// Whether the `<` that starts a tag at `at` (the last one up to there) comes after text within the same tag. Scenes
/// have no tags within text, so this is a `<` that was meant as "less than", as in `<density>1+(x<.5)</density>`.
bool isWithinText(std::string_view xml, std::size_t at);

}  // namespace tushar::input
