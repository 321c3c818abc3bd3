// SPDX-License-Identifier: Apache-2.0
// What a person can do with an XY plot, by mouse, keys and menu.
#include "ChartAction.h"
#include "QPlcXyPlotPrivate.h"
#include "gui/models/ValueFormat.h"

#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>

#include <algorithm>

using namespace qplc;

namespace {

constexpr double zoomOfKey = 0.7;  // what a key leaves
constexpr double panOfKey = 0.15;  // of the canvas
constexpr int xyDigits = 5;

QString textOf(const CurveSource &source, double value)
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
    exporter->addTableActions([this] { return table(); });
    exporter->addPictureActions();
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
    auto *menu = new QMenu(q);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    const auto add = [&](std::initializer_list<const char *> names) {
        for (const char *name : names) {
            if (auto *action = q->findChild<QAction *>(QLatin1String(name), Qt::FindDirectChildrenOnly))
                menu->addAction(action);
        }
        menu->addSeparator();
    };
    add({"all", "zoomIn", "zoomOut", "equal"});
    add({"saveTable", "copyTable", "savePicture", "copyPicture"});
    add({"panelMenu"});  // of the frame around
    return menu;
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
    return tr("x %1   y %2").arg(textOf(first.xSource(), at.x()), textOf(first.ySource(), at.y()));
}

/// The rows of the time that is seen at the moment of the wish; what several curves have in common is one column.
ChartExport::Table QPlcXyPlot::Private::table() const
{
    const SignalStore::Time end = q->windowContext() ? seenEnd() : 0;
    const SignalStore::Time begin = q->windowContext() ? end - q->windowContext()->timeView()->span() : 0;
    return [this, begin, end](TableExport::Format format) {
        std::vector<TableExport::Column> columns;
        const auto add = [&](const CurveSource &source) {
            const bool isThere = std::any_of(columns.begin(), columns.end(), [&](const TableExport::Column &each) {
                return each.store == source.store && each.channel == source.channel;
            });
            if (!isThere)
                columns.push_back({source.store, source.channel, 1.0, 0.0, CurveSource::textOf(source.title),
                                   source.unit, source.derived});
        };
        for (const std::unique_ptr<XyCurve> &curve : canvas->curves()) {
            add(curve->xSource());
            add(curve->ySource());
        }
        return TableExport(format, std::move(columns), begin, end);
    };
}
