// SPDX-License-Identifier: Apache-2.0
#include "FuzzInput.h"
#include "QPlcSignalTable.h"

// Input: a signal table. Whatever is read without an error can be written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size)
{
    const QByteArray text(reinterpret_cast<const char *>(data), int(size));
    QVector<QPlcParseError> errors;
    const QPlcSignalTable table = QPlcSignalTable::fromIni(text, &errors, QStringLiteral("fuzzed.ini"));
    fuzz::check(table.isEmpty() != errors.isEmpty(), "a table has signals, or else errors");
    for (const QPlcParseError &error : errors)
        fuzz::check(!error.toString().isEmpty() && error.line >= 0 && error.column >= 0, "an error has a place");
    if (table.isEmpty())
        return 0;

    const QByteArray written = table.toIni();
    const QPlcSignalTable again = QPlcSignalTable::fromIni(written, &errors);
    fuzz::check(errors.isEmpty(), "what was written can be read");
    fuzz::check(again.hash() == table.hash() && again.toIni() == written, "what was read again is the same");
    fuzz::check(table.unknownSignalText(QStringLiteral("noSignal")).contains(QLatin1String("noSignal"))
                    || table.contains(QStringLiteral("noSignal")),
                "an unknown name is named");
    return 0;
}
