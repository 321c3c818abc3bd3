// SPDX-License-Identifier: Apache-2.0
#include "ElidedLabel.h"

#include <QtGui/QPainter>
#include <QtGui/QTextLayout>

#include <algorithm>

namespace qplc {

ElidedLabel::ElidedLabel(QWidget *parent)
    : QLabel(parent)
{
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setTextFormat(Qt::PlainText);
}

void ElidedLabel::showText(const QString &text)
{
    if (text == this->text())
        return;
    setText(text);
    setAccessibleName(text);
    updateToolTip();
    if (m_mostLines > 1)
        updateGeometry();
}

void ElidedLabel::setMostLines(int lines)
{
    m_mostLines = lines;
    setSizePolicy(QSizePolicy::Expanding, lines > 1 ? QSizePolicy::Minimum : QSizePolicy::Fixed);
    setWordWrap(lines > 1);  // then its height depends on its width
}

void ElidedLabel::setColor(const QColor &color)
{
    QPalette colors = palette();
    if (colors.color(QPalette::WindowText) == color)
        return;
    colors.setColor(QPalette::WindowText, color);
    setPalette(colors);
}

QSize ElidedLabel::minimumSizeHint() const
{
    return {fontMetrics().averageCharWidth() * 4, fontMetrics().height()};
}

/// As they are drawn; what does not fit into the last one is elided.
QStringList ElidedLabel::linesFor(int width) const
{
    QStringList lines;
    QTextLayout layout(text(), font());
    layout.beginLayout();
    int begin = 0;
    while (begin < text().size() && lines.size() + 1 < m_mostLines) {
        QTextLine line = layout.createLine();
        line.setLineWidth(width);
        lines << text().mid(begin, line.textLength()).trimmed();
        begin += line.textLength();
    }
    layout.endLayout();
    if (begin < text().size())
        lines << fontMetrics().elidedText(text().mid(begin), Qt::ElideRight, width);
    return lines;
}

bool ElidedLabel::isElided() const
{
    const QStringList lines = linesFor(contentsRect().width());
    return !lines.isEmpty() && !text().endsWith(lines.last());
}

int ElidedLabel::heightForWidth(int width) const
{
    if (m_mostLines == 1)
        return -1;
    const int lines = std::max(1, linesFor(width).size());
    return fontMetrics().height() + (lines - 1) * fontMetrics().lineSpacing();
}

void ElidedLabel::updateToolTip()
{
    setToolTip(isElided() ? text() : QString());
}

void ElidedLabel::resizeEvent(QResizeEvent *event)
{
    QLabel::resizeEvent(event);
    updateToolTip();
}

void ElidedLabel::paintEvent(QPaintEvent *)
{
    QPainter painter(this);
    painter.setPen(palette().color(isEnabled() ? QPalette::Active : QPalette::Disabled, QPalette::WindowText));
    painter.drawText(contentsRect(), int(alignment()), linesFor(contentsRect().width()).join(QLatin1Char('\n')));
}

}  // namespace qplc
