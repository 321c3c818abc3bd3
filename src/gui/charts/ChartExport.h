// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ChartPicture.h"
#include "PlotExport.h"
#include "QPlcTheme.h"

#include <QtCore/QTimer>

#include <functional>
#include <memory>

class QLabel;

namespace qplc {

/// Brings what a chart shows into files and the clipboard, asks for names, and tells in a line at
/// the lower edge of the panel how it went. Nothing waits for it.
class ChartExport : public QObject
{
    Q_OBJECT
public:
    using Picture = std::function<std::unique_ptr<ChartPicture>()>;
    using Table = std::function<std::shared_ptr<TextTable>(TableText::Format)>;

    /// \param panel  in which it tells  \param picture  of what is seen at the moment
    ChartExport(QWidget *panel, Picture picture);

    /// Gives the panel the actions that save and copy a table, "saveTable" and "copyTable". \param
    /// table of the moment at which one of them is chosen
    void addTableActions(const std::function<Table()> &table);
    /// The same for the picture, "savePicture" and "copyPicture".
    void addPictureActions();

    void setTheme(const QPlcTheme &theme) { m_theme = theme; }
    /// \param table  makes it when the name has been chosen
    void saveTable(const Table &table);
    void copyTable(const Table &table);
    void savePicture();
    void copyPicture();
    /// Gives up a table that is being written: its stores go.
    void cancel(const QString &reason) { m_export.cancel(reason); }
    /// Hides what was told. \return whether there was something
    bool dismiss();

protected:
    bool eventFilter(QObject *watched, QEvent *event) override;

private:
    void say(const QString &sentence, bool isFailure);
    void place();

    QWidget *m_panel;
    Picture m_picture;
    QPlcTheme m_theme;
    PlotExport m_export;
    QLabel *m_notice;
    QTimer m_timer;
};

}  // namespace qplc
