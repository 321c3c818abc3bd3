// SPDX-License-Identifier: Apache-2.0
#include "ChartExport.h"

#include "gui/panel/PanelAction.h"

#include <QtCore/QEvent>
#include <QtGui/QClipboard>
#include <QtGui/QGuiApplication>
#include <QtWidgets/QFileDialog>
#include <QtWidgets/QLabel>

namespace qplc {

namespace {

constexpr int successTime = 6000;  // [ms] that good news are shown

/// A dialog that asks for a file, and goes on at once.
QFileDialog *openDialog(QWidget *parent, const QString &title, const QStringList &filters, const QString &suffix)
{
    auto *dialog = new QFileDialog(parent, title);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setNameFilters(filters);
    dialog->setDefaultSuffix(suffix);
    dialog->open();
    return dialog;
}

}  // namespace

ChartExport::ChartExport(QWidget *panel, Picture picture)
    : QObject(panel)
    , m_panel(panel)
    , m_picture(std::move(picture))
    , m_export(this)
    , m_notice(new QLabel(panel))
{
    m_notice->hide();
    m_notice->setWordWrap(true);
    m_notice->setMargin(6);
    m_notice->setAutoFillBackground(true);
    m_notice->setFrameShape(QFrame::StyledPanel);
    m_notice->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_timer.setSingleShot(true);
    m_panel->installEventFilter(this);
    connect(&m_timer, &QTimer::timeout, m_notice, &QWidget::hide);
    connect(&m_export, &PlotExport::finished, this, [this](const QString &text) { say(text, false); });
    connect(&m_export, &PlotExport::failed, this, [this](const QString &text) { say(text, true); });
}

void ChartExport::addTableActions(const std::function<Table()> &table)
{
    addPanelAction(
        m_panel, tr("Export as CSV..."), {int(Qt::CTRL) | Qt::Key_E}, [this, table] { saveTable(table()); },
        "saveTable");
    addPanelAction(
        m_panel, tr("Copy as table"), {int(Qt::CTRL) | Qt::Key_C}, [this, table] { copyTable(table()); }, "copyTable");
}

void ChartExport::addPictureActions()
{
    addPanelAction(
        m_panel, tr("Save picture..."), {int(Qt::CTRL | Qt::SHIFT) | Qt::Key_E}, [this] { savePicture(); },
        "savePicture");
    addPanelAction(
        m_panel, tr("Copy picture"), {int(Qt::CTRL | Qt::SHIFT) | Qt::Key_C}, [this] { copyPicture(); }, "copyPicture");
}

void ChartExport::saveTable(const Table &table)
{
    QFileDialog *dialog
        = openDialog(m_panel, tr("Export as a table"), {tr("Comma-separated values (*.csv)")}, QStringLiteral("csv"));
    connect(dialog, &QFileDialog::fileSelected, this,
            [this, table](const QString &name) { m_export.save(table(TableText::Csv), name); });
}

void ChartExport::copyTable(const Table &table)
{
    m_export.copy(table(TableText::Tsv));
}

void ChartExport::savePicture()
{
    QFileDialog *dialog
        = openDialog(m_panel, tr("Save a picture"), {tr("Picture (*.png)"), tr("Drawing (*.svg)"), tr("Page (*.pdf)")},
                     QStringLiteral("png"));
    connect(dialog, &QFileDialog::filterSelected, dialog, [dialog](const QString &filter) {
        dialog->setDefaultSuffix(filter.section(QLatin1String("*."), 1).chopped(1));
    });
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString &name) {
        const QString failure = m_picture()->save(name);
        const bool isFailure = !failure.isEmpty();
        say(isFailure ? failure : tr("The picture is in %1.").arg(name), isFailure);
    });
}

void ChartExport::copyPicture()
{
    QGuiApplication::clipboard()->setImage(m_picture()->image());
    say(tr("The picture is in the clipboard."), false);
}

bool ChartExport::dismiss()
{
    const bool wasThere = !m_notice->isHidden();
    m_notice->hide();
    return wasThere;
}

void ChartExport::say(const QString &sentence, bool isFailure)
{
    QPalette palette = m_panel->palette();
    palette.setColor(QPalette::WindowText, isFailure ? m_theme.alarm : m_theme.text);
    m_notice->setPalette(palette);
    m_notice->setText(isFailure ? tr("%1 (Esc)").arg(sentence) : sentence);
    m_notice->show();
    place();
    isFailure ? m_timer.stop() : m_timer.start(successTime);
}

/// Over the rest, which stays where it is.
void ChartExport::place()
{
    const int height = m_notice->heightForWidth(m_panel->width());
    m_notice->setGeometry(0, m_panel->height() - height, m_panel->width(), height);
    m_notice->raise();
}

bool ChartExport::eventFilter(QObject *watched, QEvent *event)
{
    if (event->type() == QEvent::Resize && !m_notice->isHidden())
        place();
    return QObject::eventFilter(watched, event);
}

}  // namespace qplc
