// Text of files, made safe for reports: names and values are hostile bytes like all others.
#pragma once

#include <string>
#include <string_view>

namespace zerotree::validate {

/// `text` with each byte that is no part of a UTF-8 character which XML 1.0 can hold, control
/// characters among them, as a replacement character. So it neither breaks a document nor moves a
/// terminal's cursor.
std::string printable_text(std::string_view text);

/// The same with a space for each line break and tab: a name cannot pass for a line of its own.
std::string printable_line(std::string_view text);

}  // namespace zerotree::validate
