// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/plot/TextTable.h"

#include <QtCore/QObject>
#include <QtCore/QSaveFile>
#include <QtCore/QTimer>

#include <memory>

namespace qplc {

/// Writes a table into a file or the clipboard, a piece between events, so that the window goes on;
/// one table at a time.
///
/// A file is there when all of it is written, and as it was before when something fails.
class PlotExport : public QObject
{
    Q_OBJECT
public:
    explicit PlotExport(QObject *parent);

    /// Begins; another one that has not finished is given up. What the table reads has to live
    /// until finished() or failed(): else cancel() first.
    void save(std::shared_ptr<TextTable> table, const QString &fileName);
    void copy(std::shared_ptr<TextTable> table);
    bool isBusy() const { return m_table != nullptr; }
    /// Gives up, and says so when there was something.
    void cancel(const QString &reason);

Q_SIGNALS:
    /// A sentence for people.
    void finished(const QString &sentence);
    void failed(const QString &sentence);

private:
    void begin(std::shared_ptr<TextTable> table);
    void goOn();
    void end();
    void fail(const QString &sentence);
    void forget();

    QTimer m_timer;
    std::shared_ptr<TextTable> m_table;
    std::unique_ptr<QSaveFile> m_file;  // null: the clipboard
    QByteArray m_text;                  // for the clipboard
};

}  // namespace qplc
