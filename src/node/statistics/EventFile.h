// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "realtime/LogWriter.h"
#include "transport/Descriptor.h"

#include <QtCore/QString>

#include <functional>
#include <memory>
#include <mutex>

namespace qplc {

/// Writes lines to a file that keeps its size: docs/design/event-files.md has the reasons.
///
/// A file that is full gets the number 1 behind its name, that one the number 2, and so on; the
/// oldest one is removed. What cannot be written is lost and counted, and a second later the file
/// is opened again.
class EventFile final : public LogOutput
{
public:
    static constexpr qint64 usualSize = 8 << 20;  // [byte] of one file
    static constexpr int mostFiles = 8;           // with the one that is written
    static constexpr int mostMasters = 16;        // with the same usual name, at the same time

    /// Where it is.
    struct Place
    {
        QString path;
        /// The library has chosen it: its folder is made, and where another master uses the file,
        /// "-2", "-3", ... stands behind its name.
        bool isUsual = false;
    };
    /// What has happened to it.
    struct Report
    {
        QString path;        // of the open file; empty: it was never open
        QString problem;     // the last one
        bool fails = false;  // the last line was not written
        quint64 lost = 0;    // lines
        qint64 removed = 0;  // [byte] of an incomplete last line that was there before
    };
    /// The report of a file, for any thread: the file itself belongs to that of its writer.
    class SharedReport
    {
    public:
        Report report() const;
        void change(const std::function<void(Report *)> &change);

    private:
        mutable std::mutex m_mutex;
        Report m_report;
    };

    EventFile(Place place, std::shared_ptr<SharedReport> report, qint64 mostBytes = usualSize);
    ~EventFile() override;

    void write(const QByteArray &line) override;
    int rest() override;
    /// The numbers of the events show what is missing.
    QByteArray gapText(quint64) const override { return {}; }

    /// The file of a master with this name. The path is empty where the user has no folder.
    static Place usualPlace(const QString &name);
    /// Name of the \a number-th file, from 1, before the one that is written, 0.
    static QString numbered(const QString &path, int number);

private:
    bool open(QString *problem);
    bool openFolder(QString *problem);
    bool openFile(const QByteArray &name, QString *problem);
    bool lockUnused(QString *problem);
    bool heal(QString *problem);
    bool makeRoom(QString *problem);
    bool append(const QByteArray &line, QString *problem);
    bool syncWhenDue(QString *problem);
    void fail(const QString &problem);

    const Place m_place;
    const std::shared_ptr<SharedReport> m_report;
    const qint64 m_mostBytes;
    Descriptor m_folder;
    Descriptor m_file;
    QByteArray m_name;  // of the file
    qint64 m_size = 0;
    std::int64_t m_nextTry = 0;  // [ns]
    std::int64_t m_nextSync = 0;
    bool m_isDirty = false;
};

}  // namespace qplc
