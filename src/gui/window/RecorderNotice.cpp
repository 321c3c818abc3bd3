// SPDX-License-Identifier: Apache-2.0
#include "RecorderNotice.h"

#include "gui/WindowText.h"
#include "node/state/StateText.h"

#include <QtGui/QPainter>

namespace qplc {

namespace {

using messages::RecorderState;

constexpr double DotRadius = 5.0;  // [px]
constexpr int DotSpace = 20;       // [px]

QString rateText(double bytesPerSecond)
{
    const double kilobytes = bytesPerSecond / 1e3;
    return kilobytes < 10e3 ? WindowText::tr("%1 kB/s").arg(kilobytes, 0, 'f', kilobytes < 10.0 ? 1 : 0)
                            : WindowText::tr("%1 MB/s").arg(kilobytes / 1e3, 0, 'f', 0);
}

}  // namespace

RecorderSummary RecorderSummary::of(const messages::RecorderEntry &recorder)
{
    RecorderSummary summary;
    summary.isRecording = recorder.state == RecorderState::Recording;
    QStringList more{WindowText::tr("Recorder: %1").arg(recorderText(recorder))};
    if (recorder.missing > 0)
        more << WindowText::tr("%1 cycles of this phase are missing").arg(recorder.missing);
    if (!recorder.file.isEmpty())
        more << recorder.file;
    summary.more = more.join(QLatin1Char('\n'));
    switch (recorder.state) {
    case RecorderState::Recording:
        summary.tone = recorder.missing > 0 ? Tone::Warning : Tone::Calm;
        summary.text = recorder.missing > 0 ? WindowText::tr("%1 missing").arg(recorder.missing)
                                            : rateText(recorder.bytesPerSecond);
        break;
    case RecorderState::None:
        summary.text = WindowText::tr("not recording");
        break;
    case RecorderState::Stopped:
        summary.text = WindowText::tr("stopped");
        break;
    case RecorderState::DiskFull:
        summary.tone = Tone::Alarm;
        summary.text = WindowText::tr("disk full");
        break;
    case RecorderState::Failing:
        summary.tone = Tone::Alarm;
        summary.text = WindowText::tr("write error");
        break;
    case RecorderState::Stalled:
        summary.tone = Tone::Warning;
        summary.text = WindowText::tr("stalled");
        break;
    case RecorderState::Gone:
        summary.tone = Tone::Alarm;
        summary.text = WindowText::tr("recorder gone");
        break;
    case RecorderState::Unknown:
        return {};
    }
    return summary;
}

RecorderNotice::RecorderNotice(const PlantSelection *selection, WindowContext *context, QWidget *parent)
    : QWidget(parent)
    , m_selection(selection)
    , m_context(context)
{
    setObjectName(QStringLiteral("RecorderNotice"));
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
    connect(context, &WindowContext::themeChanged, this, QOverload<>::of(&QWidget::update));
    connect(selection, &PlantSelection::changed, this, &RecorderNotice::follow);
    follow();
}

void RecorderNotice::follow()
{
    const Plant *plant = m_selection->plant();
    const bool isKnown = plant && plant->isConnected() && plant->status().master.recorder;
    m_summary = isKnown ? RecorderSummary::of(*plant->status().master.recorder) : RecorderSummary();
    setToolTip(m_summary.more);
    setAccessibleName(m_summary.more);
    update();
}

QSize RecorderNotice::sizeHint() const
{
    return {textLeft() + fontMetrics().horizontalAdvance(WindowText::tr("recorder gone")) + 8, 26};
}

int RecorderNotice::textLeft() const
{
    QFont bold = font();
    bold.setBold(true);
    return DotSpace + QFontMetrics(bold).horizontalAdvance(QStringLiteral("REC "));
}

/// A filled dot: cycles go into a file.
void RecorderNotice::paintEvent(QPaintEvent * /*event*/)
{
    if (m_summary.text.isEmpty())
        return;
    const Theme &theme = m_context->theme();
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QColor ink = colorOf(theme, m_summary.tone);
    const QColor dot = m_summary.isRecording ? theme.alarm : ink;
    painter.setPen(QPen(dot, 1.5));
    painter.setBrush(m_summary.isRecording ? QBrush(dot) : QBrush(Qt::NoBrush));
    painter.drawEllipse(QPointF(DotRadius + 5.0, height() / 2.0), DotRadius, DotRadius);
    QFont bold = font();
    bold.setBold(true);
    painter.setFont(bold);
    painter.setPen(m_summary.isRecording ? theme.text : ink);
    painter.drawText(rect().adjusted(DotSpace, 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter, QStringLiteral("REC"));
    painter.setFont(font());
    painter.setPen(m_summary.tone == Tone::Calm ? theme.mutedText : ink);
    painter.drawText(rect().adjusted(textLeft(), 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter, m_summary.text);
}

}  // namespace qplc
