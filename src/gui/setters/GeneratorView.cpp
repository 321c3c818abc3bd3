// SPDX-License-Identifier: Apache-2.0
#include "SetterView.h"
#include "Waveform.h"
#include "gui/panel/NumberBox.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QSignalBlocker>
#include <QtCore/QTimer>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>

namespace qplc {

namespace {

const char *const shapeNames[] = {"step", "ramp", "sine"};
constexpr double shortestPeriod = 0.1;  // [s]
constexpr double longestPeriod = 86400.0;
constexpr double largest = 1e9;

/// A test signal: steps, ramps or a sine, a new value every 20 ms. Stops with neutral when it is
/// hidden, when the phase of the plant ends, and when control is lost.
class GeneratorView : public SetterView
{
public:
    static constexpr int StepTime = 20;  // [ms]

    GeneratorView(SetterTarget *target, QWidget *parent)
        : SetterView(target, parent)
    {
        makeFields();
        m_timer.setTimerType(Qt::PreciseTimer);
        m_timer.setInterval(StepTime);
        connect(&m_timer, &QTimer::timeout, this, &GeneratorView::step);
        connect(m_start, &QPushButton::clicked, this, &GeneratorView::toggle);
        connect(&target->control(), &QPlcSignalControl::holdLost, this,
                [this] { stop(tr("Stopped: control was lost")); });
        connect(&target->control(), &QPlcSignalControl::failed, this, [this](const QString &sentence) {
            if (isRunning())
                stop(sentence);
        });
        showWaveform();
        refresh();
    }

    ~GeneratorView() override
    {
        m_timer.stop();
        target().endAction();
    }

    void refresh() override
    {
        m_start->setEnabled(isRunning() || (target().control().mayWrite() && target().isNumber()));
        m_start->setText(isRunning() ? tr("Stop") : tr("Start"));
    }

    void applySettings(const QJsonObject &settings) override
    {
        const QJsonObject of = settings.value(QStringLiteral("generator")).toObject();
        m_waveform = {};
        for (int shape = 0; shape < 3; ++shape) {
            if (of.value(QStringLiteral("shape")).toString() == QLatin1String(shapeNames[shape]))
                m_waveform.shape = Waveform::Shape(shape);
        }
        m_waveform.amplitude = of.value(QStringLiteral("amplitude")).toDouble(m_waveform.amplitude);
        m_waveform.offset = of.value(QStringLiteral("offset")).toDouble(m_waveform.offset);
        const double period = of.value(QStringLiteral("period")).toDouble(m_waveform.period);
        m_waveform.period = qBound(shortestPeriod, period, longestPeriod);
        showWaveform();
    }

    bool isRunning() const { return m_timer.isActive(); }

protected:
    void hideEvent(QHideEvent *event) override
    {
        SetterView::hideEvent(event);
        stop(tr("Stopped: the panel is not visible"));
    }

private:
    void makeFields()
    {
        auto *grid = new QGridLayout(this);
        grid->setContentsMargins(0, 0, 0, 0);
        grid->setSpacing(2);
        m_shape = new QComboBox(this);
        m_shape->addItems({tr("Step"), tr("Ramp"), tr("Sine")});
        m_shape->setAccessibleName(tr("Shape"));
        m_start = new QPushButton(tr("Start"), this);
        grid->addWidget(m_shape, 0, 0, 1, 2);
        grid->addWidget(m_start, 0, 2);
        m_amplitude = makeField(tr("Amplitude"), 0, &Waveform::amplitude);
        m_offset = makeField(tr("Offset"), 1, &Waveform::offset);
        m_period = makeField(tr("Period"), 2, &Waveform::period);
        m_period->setRange(shortestPeriod, longestPeriod);
        m_period->setSuffix(QStringLiteral(" s"));
        m_period->setPrefix(QStringLiteral("T "));
        m_amplitude->setPrefix(QStringLiteral("± "));
        m_offset->setPrefix(QStringLiteral("∅ "));
        setFocusProxy(m_start);
        connect(m_shape, qOverload<int>(&QComboBox::activated), this, [this](int shape) {
            m_waveform.shape = Waveform::Shape(shape);
            Q_EMIT generatorEdited(settings());
        });
    }

    NumberBox *makeField(const QString &name, int column, double Waveform::*number)
    {
        auto *field = new NumberBox(-largest, largest, this);
        field->setButtonSymbols(QAbstractSpinBox::NoButtons);
        field->setMinimumWidth(60);
        field->setToolTip(name);
        field->setAccessibleName(name);
        static_cast<QGridLayout *>(layout())->addWidget(field, 1, column);
        connect(field, qOverload<double>(&NumberBox::valueChanged), this, [this, number](double value) {
            m_waveform.*number = value;
            Q_EMIT generatorEdited(settings());
        });
        return field;
    }

    void showWaveform()
    {
        const QSignalBlocker blockers[]
            = {QSignalBlocker(m_amplitude), QSignalBlocker(m_offset), QSignalBlocker(m_period)};
        m_shape->setCurrentIndex(m_waveform.shape);
        m_amplitude->setValue(m_waveform.amplitude);
        m_offset->setValue(m_waveform.offset);
        m_period->setValue(m_waveform.period);
    }

    void toggle()
    {
        if (isRunning())
            stop({});
        else
            start();
    }

    void start()
    {
        if (!target().beginAction(m_waveform.value(0.0)))
            return;
        m_wasPlantRunning = isPlantRunning();
        m_time.start();
        m_timer.start();
        Q_EMIT said(QString());
        refresh();
    }

    void stop(const QString &why)
    {
        if (!isRunning())
            return;
        m_timer.stop();
        target().endAction();
        Q_EMIT said(why);
        refresh();
    }

    void step()
    {
        const bool wasPlantRunning = m_wasPlantRunning;
        m_wasPlantRunning = isPlantRunning();
        if (wasPlantRunning && !m_wasPlantRunning) {
            stop(tr("Stopped: the plant was stopped"));
            return;
        }
        target().stream(m_waveform.value(double(m_time.nsecsElapsed()) * 1e-9));
    }

    bool isPlantRunning() const { return target().plant().isRunning; }

    QJsonObject settings() const
    {
        const Waveform plain;
        QJsonObject of;
        if (m_waveform.shape != plain.shape)
            of.insert(QStringLiteral("shape"), QLatin1String(shapeNames[m_waveform.shape]));
        if (m_waveform.amplitude != plain.amplitude)
            of.insert(QStringLiteral("amplitude"), m_waveform.amplitude);
        if (m_waveform.offset != plain.offset)
            of.insert(QStringLiteral("offset"), m_waveform.offset);
        if (m_waveform.period != plain.period)
            of.insert(QStringLiteral("period"), m_waveform.period);
        return of;
    }

    Waveform m_waveform;
    QComboBox *m_shape = nullptr;
    NumberBox *m_amplitude = nullptr;
    NumberBox *m_offset = nullptr;
    NumberBox *m_period = nullptr;
    QPushButton *m_start = nullptr;
    QTimer m_timer;
    QElapsedTimer m_time;
    bool m_wasPlantRunning = false;  // at the step before
};

}  // namespace

SetterView *createGeneratorView(SetterTarget *target, QWidget *parent)
{
    return new GeneratorView(target, parent);
}

}  // namespace qplc
