// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "SetterView.h"
#include "Waveform.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QTimer>

class QComboBox;
class QPushButton;

namespace qplc {

class NumberBox;

/// A test signal: steps, ramps or a sine, a new value every 20 ms. Stops with neutral when it is
/// hidden, when the phase of the plant ends, and when control is lost.
class GeneratorView : public SetterView
{
    Q_OBJECT
public:
    static constexpr int StepTime = 20;  // [ms]

    GeneratorView(SetterTarget *target, QWidget *parent);
    ~GeneratorView() override;
    void refresh() override;
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    bool isRunning() const { return m_timer.isActive(); }

protected:
    void hideEvent(QHideEvent *event) override;

private:
    void makeFields();
    NumberBox *makeField(const QString &name, int column, double Waveform::*number);
    void showWaveform();
    void toggle();
    void start();
    void stop(const QString &why);
    void step();
    bool isPlantRunning() const;

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

}  // namespace qplc
