// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "QPlcManifest.h"

// Input: a manifest. Whatever is read without an error can be written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    const QByteArray text(reinterpret_cast<const char *>(data), int(size));
    QVector<QPlcParseError> errors;
    const QPlcManifest manifest = QPlcManifest::fromIni(text, &errors, QStringLiteral("fuzzed.ini"));
    fuzz::check(manifest.isEmpty() != errors.isEmpty(), "a manifest has nodes, or else errors");
    for (const QPlcParseError &error : errors)
        fuzz::check(!error.toString().isEmpty() && error.line >= 0 && error.column >= 0, "an error has a place");
    if (manifest.isEmpty())
        return 0;

    const QByteArray written = manifest.toIni();
    const QPlcManifest again = QPlcManifest::fromIni(written, &errors);
    fuzz::check(errors.isEmpty(), "what was written can be read");
    fuzz::check(again.toIni() == written && again.nodes.size() == manifest.nodes.size(),
                "what was read again is the same");
    for (const QPlcManifest::Node &node : manifest.nodes)
        fuzz::check(again.find(node.name) && again.find(node.name)->watchdog == node.watchdog, "each node is found");
    return 0;
}
