// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QJsonArray>
#include <QtGui/QPainter>
#include <QtPlcGui>

/// Two signals over the time that the window shows, each with a scale of its own.
class TwoCurves : public QPlcWidget
{
public:
    static QString typeName() { return QStringLiteral("Two curves"); }  // as layouts call it
    using QPlcWidget::QPlcWidget;
    QString kind() const override { return typeName(); }
    QStringList shownSignals() const override { return setting("signals").toVariant().toStringList(); }
    bool addSignals(const QStringList &references) override  // that a person drops here
    {
        const QStringList all = shownSignals() + references;
        setSetting("signals", QJsonArray::fromStringList(all.mid(qMax(0, all.size() - 2))));
        return true;
    }

protected:
    void contextChanged() override
    {
        connect(context(), &QPlcPanelContext::changed, this, QOverload<>::of(&QWidget::update));
    }
    void paintEvent(QPaintEvent *) override
    {
        const QPlcTheme theme = context()->theme();
        QPainter painter(this);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.fillRect(rect(), theme.surface);
        const int line = painter.fontMetrics().height();
        for (int i = 0; i < shownSignals().size(); ++i) {
            const QString name = shownSignals().at(i);
            const QPlcPanelContext::Signal signal = context()->shown(name);
            painter.setPen(QPen(theme.curve(i), theme.curveWidth));
            painter.drawText(8, (i + 1) * line, signal ? name + "  " + context()->text(signal) : signal.problem);
            drawCurve(&painter, name, rect().adjusted(8, 3 * line, -8, -line));
        }
    }
    void drawCurve(QPainter *painter, const QString &name, const QRectF &area)
    {
        const qint64 begin = context()->begin(), end = context()->end();
        const QVector<QPlcPanelContext::Sample> past = context()->history(name, begin, end, width());
        double least = qInf(), most = -qInf();
        for (const QPlcPanelContext::Sample &each : past)
            least = qMin(least, each.minimum), most = qMax(most, each.maximum);
        QPointF before;
        for (const QPlcPanelContext::Sample &each : past) {
            const double x = double(each.time - begin) / double(end - begin);
            const double y = most > least ? (most - each.value) / (most - least) : 0.5;
            const QPointF here(area.x() + x * area.width(), area.y() + y * area.height());
            if (each.isJoined)
                painter->drawLine(before, here);
            before = here;
        }
    }
};
