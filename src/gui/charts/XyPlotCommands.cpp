// SPDX-License-Identifier: Apache-2.0
// What a person can do with an XY plot, by mouse, keys and menu.
#include "ChartAction.h"
#include "QPlcTimeAxis.h"
#include "QPlcXyPlotPrivate.h"
#include "gui/models/ValueFormat.h"

#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>

using namespace qplc;

namespace {

constexpr double zoomOfKey = 0.7;  // what a key leaves
constexpr double panOfKey = 0.15;  // of the canvas
constexpr int xyDigits = 5;

QString textOf(const QPlcPast &source, double value)
{
    const QString unit = source.unit.isEmpty() ? QString() : QLatin1Char(' ') + source.unit;
    return QStringLiteral("%1%2").arg(numberText(value, xyDigits), unit);
}

}  // namespace

void QPlcXyPlot::Private::makeActions()
{
    const auto key = [](int code) { return QKeySequence(code); };
    const auto make = [this](const QString &text, const QList<QKeySequence> &keys, const char *name,
                             std::function<void()> act) { return addChartAction(q, text, keys, name, std::move(act)); };
    const auto pan = [this](double x, double y) {
        return [this, x, y] {
            const QSizeF size = canvas->canvas()->size();
            canvas->pan({x * panOfKey * size.width(), y * panOfKey * size.height()});
        };
    };
    equal = make(tr("Equal aspect"), {key(Qt::Key_E)}, "equal", [this] {
        q->setAspectEqual(equal->isChecked());
        Q_EMIT q->settingsEdited();
    });
    equal->setCheckable(true);
    make(tr("Show all"), {key(Qt::Key_A)}, "all", [this] { canvas->release(); });
    make(tr("Zoom in"), {key(Qt::Key_Plus), key(Qt::Key_Equal)}, "zoomIn", [this] { zoom(zoomOfKey); });
    make(tr("Zoom out"), {key(Qt::Key_Minus)}, "zoomOut", [this] { zoom(1.0 / zoomOfKey); });
    make(tr("Move left"), {key(Qt::Key_Left)}, "left", pan(1.0, 0.0));
    make(tr("Move right"), {key(Qt::Key_Right)}, "right", pan(-1.0, 0.0));
    make(tr("Move up"), {key(Qt::Key_Up)}, "up", pan(0.0, 1.0));
    make(tr("Move down"), {key(Qt::Key_Down)}, "down", pan(0.0, -1.0));
    exporter()->addTableActions([this] { return table(); });
    exporter()->addPictureActions();
}

void QPlcXyPlot::Private::connectInteraction()
{
    connect(interaction, &XyInteraction::pressed, q, [this] { q->setFocus(Qt::MouseFocusReason); });
    connect(interaction, &XyInteraction::mouseMoved, q, [this] { showMoment(); });
    connect(interaction, &XyInteraction::allWanted, q, [this] { canvas->release(); });
    connect(interaction, &XyInteraction::menuWanted, q,
            [this](const QPoint &, const QPoint &global) { createMenu()->popup(global); });
}

QMenu *QPlcXyPlot::Private::createMenu()
{
    return makeMenu({{"all", "zoomIn", "zoomOut", "equal"},
                     {"saveTable", "copyTable", "savePicture", "copyPicture"},
                     {"panelMenu"}});  // of the frame around
}

/// About the mouse, or the middle.
void QPlcXyPlot::Private::zoom(double factor)
{
    const QPointF middle = QRectF(canvas->canvas()->rect()).center();
    canvas->zoom(factor, factor, interaction->mouse() ? QPointF(*interaction->mouse()) : middle);
}

/// x and y below the mouse.
QString QPlcXyPlot::Private::pointerText() const
{
    if (canvas->curves().empty())
        return {};
    const QPointF at = canvas->valueAt(*interaction->mouse());
    const XyCurve &first = *canvas->curves().front();
    return tr("x %1   y %2").arg(textOf(first.x(), at.x()), textOf(first.y(), at.y()));
}

/// The rows of the time that is seen at the moment of the wish; what several curves have in common
/// is one column.
ChartExport::Table QPlcXyPlot::Private::table() const
{
    const QPlcPast::Time end = seenEnd();
    const QPlcPast::Time begin = end - context()->timeAxis()->span();
    return [this, begin, end](TableExport::Format format) {
        std::vector<TableExport::Column> columns;
        QStringList added;
        for (const std::unique_ptr<XyCurve> &curve : canvas->curves()) {
            for (const QPlcPast &past : {curve->x(), curve->y()}) {
                if (!added.contains(past.expression))
                    columns.push_back(TableExport::Column::of(past, past.text()));
                added << past.expression;
            }
        }
        return TableExport(format, std::move(columns), begin, end);
    };
}
