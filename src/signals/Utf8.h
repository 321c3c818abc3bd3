// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace qplc {

/// Position of the first byte that is not part of well-formed UTF-8 (RFC 3629: shortest form, no
/// surrogates, at most U+10FFFF); -1 when there is none.
int firstInvalidUtf8(const char *bytes, int size);

/// Number of characters that begin in \a bytes.
int utf8Characters(const char *bytes, int size);

}  // namespace qplc
