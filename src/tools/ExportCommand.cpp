// SPDX-License-Identifier: Apache-2.0
// export: a recording as a table for other programs.
#include "RecordingChoice.h"
#include "TerminalText.h"
#include "recording/RecordingTable.h"

#include <QtCore/QFileInfo>
#include <QtCore/QJsonObject>

#include <limits>

namespace tools {

namespace {

constexpr QLatin1String mat("mat", 3);

/// \return empty, with the message out, when there is no such format
QString formatOf(const CommandCall &call, const QString &output)
{
    const QString option = QStringLiteral("format");
    const QString format = call.application.isSet(option) ? call.application.value(option) : QFileInfo(output).suffix();
    const QStringList formats = qplc::TableWriter::formats();
    if (formats.contains(format) && format == mat && output == QLatin1String(qplc::OutputFile::StandardOutput)) {
        call.application.usageError(
            QStringLiteral("mat is not written in one go, so it needs a file; use --output FILE"));
        return {};
    }
    if (formats.contains(format))
        return format;
    const QStringList pictures{QStringLiteral("video"), QStringLiteral("frames"), QStringLiteral("mp4"),
                               QStringLiteral("webm"), QStringLiteral("png")};
    if (pictures.contains(format)) {
        call.application.usageError(
            QStringLiteral(
                "qtplc draws no pictures; a Control Center does: awe_control_center --recording '%1' --video "
                "'%2'")
                .arg(call.arguments.value(0), output));
        return {};
    }
    const bool isMat = format == mat;
    call.application.usageError(isMat ? QStringLiteral("this qtplc was built without HDF5, so it writes no mat")
                                      : QStringLiteral("'%1' is not a format; use --format %2")
                                            .arg(format, formats.join(QStringLiteral(" or --format "))));
    return {};
}

bool writeTable(qplc::RecordingTable *table, qplc::TableWriter *writer, QString *error)
{
    if (!writer->begin(table->columns(), error))
        return false;
    qplc::TableBlock block;
    while (table->next(&block)) {
        if (!writer->add(block, error))
            return false;
    }
    return writer->end(error);
}

}  // namespace

int exportRecording(const CommandCall &call)
{
    const QString name = call.application.value(QStringLiteral("output"));
    if (name.isEmpty())
        return call.application.usageError(QStringLiteral("no file to write to; use --output FILE"));
    const QString format = formatOf(call, name);
    qint64 every = 1;
    qplc::Recording recording;
    qplc::TableSelection selection;
    if (format.isEmpty() || !call.readInteger("every", 1, std::numeric_limits<qint32>::max(), &every)
        || !openRecording(call, call.arguments.value(0), &recording)
        || !readTimes(call, recording, &selection.begin, &selection.end)
        || !readSignals(call, recording, &selection.signalNumbers))
        return call.application.exitCode();
    selection.every = std::uint64_t(every);
    selection.hasQualities = !call.application.isSet(QStringLiteral("values-only"));
    const std::unique_ptr<qplc::OutputFile> file = openOutput(call, recording);
    if (!file)
        return call.application.exitCode();
    const std::unique_ptr<qplc::TableWriter> writer = qplc::TableWriter::create(format, file.get());
    qplc::RecordingTable table(recording, selection);
    QString error;
    if (!writeTable(&table, writer.get(), &error) || !file->commit(&error)) {
        QPlcCoreApplication::printError(error);
        return QPlcCoreApplication::Failure;
    }
    printWritten(call,
                 {{QStringLiteral("rows"), double(table.rows())},
                  {QStringLiteral("columns"), int(table.columns().size())},
                  {QStringLiteral("damages"), table.damages()}},
                 QStringLiteral("%1 rows, %2 columns").arg(table.rows()).arg(table.columns().size()));
    return exitCodeOf(recording, table.damages());
}

}  // namespace tools
