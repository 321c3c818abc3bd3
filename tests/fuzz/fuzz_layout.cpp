// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "gui/layout/LayoutJson.h"

// Input: the text of a layout file. What is read can be written and read again, and is sound after
// an edit.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    const QByteArray text(reinterpret_cast<const char *>(data), int(size));
    QPlcParseError error;
    const std::optional<qplc::Layout> layout = qplc::layoutFromJson(text, &error);
    if (!layout) {
        fuzz::check(!error.message.isEmpty(), "a refusal has a reason");
        return 0;
    }
    fuzz::check(layout->invariantError().isEmpty(), "a layout that was read is sound");
    const QByteArray written = qplc::layoutToJson(*layout);
    const std::optional<qplc::Layout> again = qplc::layoutFromJson(written, &error);
    fuzz::check(again.has_value(), "what was written can be read");
    fuzz::check(qplc::layoutToJson(*again) == written, "what was read again is the same");
    return 0;
}
