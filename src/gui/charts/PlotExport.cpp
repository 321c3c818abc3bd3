// SPDX-License-Identifier: Apache-2.0
#include "PlotExport.h"

#include <QtGui/QClipboard>
#include <QtGui/QGuiApplication>

namespace qplc {

namespace {

constexpr int rowsOfPiece = 2000;                   // some milliseconds
constexpr int largestClipboard = 64 * 1024 * 1024;  // [bytes]

}  // namespace

PlotExport::PlotExport(QObject *parent)
    : QObject(parent)
{
    m_timer.setInterval(0);
    connect(&m_timer, &QTimer::timeout, this, &PlotExport::goOn);
}

void PlotExport::save(std::shared_ptr<TextTable> table, const QString &fileName)
{
    forget();
    m_file = std::make_unique<QSaveFile>(fileName);
    if (!m_file->open(QIODevice::WriteOnly)) {
        fail(tr("%1 cannot be written: %2. Choose another place.").arg(fileName, m_file->errorString()));
        return;
    }
    begin(std::move(table));
}

void PlotExport::copy(std::shared_ptr<TextTable> table)
{
    forget();
    begin(std::move(table));
}

void PlotExport::begin(std::shared_ptr<TextTable> table)
{
    m_table = std::move(table);
    if (m_file)
        m_file->write(m_table->header());
    else
        m_text = m_table->header();
    m_timer.start();
}

void PlotExport::goOn()
{
    const QByteArray piece = m_table->next(rowsOfPiece);
    if (m_file && m_file->write(piece) != piece.size()) {
        fail(tr("%1 cannot be written: %2. Choose another place.").arg(m_file->fileName(), m_file->errorString()));
        return;
    }
    if (!m_file)
        m_text += piece;
    if (m_text.size() > largestClipboard)
        fail(tr("%1 rows are too many for the clipboard: save them as a file, or show less.").arg(m_table->rows()));
    else if (m_table->isAtEnd())
        end();
}

void PlotExport::end()
{
    const qint64 rows = m_table->rows();
    if (!m_file) {
        QGuiApplication::clipboard()->setText(QString::fromUtf8(m_text));
        forget();
        Q_EMIT finished(tr("%1 rows are in the clipboard.").arg(rows));
        return;
    }
    if (!m_file->commit()) {
        fail(tr("%1 cannot be written: %2. Choose another place.").arg(m_file->fileName(), m_file->errorString()));
        return;
    }
    const QString name = m_file->fileName();
    forget();
    Q_EMIT finished(tr("%1 rows are in %2.").arg(rows).arg(name));
}

void PlotExport::cancel(const QString &reason)
{
    if (isBusy())
        fail(reason);
}

void PlotExport::fail(const QString &sentence)
{
    forget();
    Q_EMIT failed(sentence);
}

void PlotExport::forget()
{
    m_timer.stop();
    m_table.reset();
    m_file.reset();
    m_text.clear();
}

}  // namespace qplc
