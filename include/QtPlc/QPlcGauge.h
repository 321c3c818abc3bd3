// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// One signal, or something calculated of signals, as an instrument: a dial, a bar, a large number, or an LED.
///
/// ```cpp
/// auto *gauge = new QPlcGauge;
/// gauge->applySettings({{"signal", "tetherForce"}, {"style", "bar"}, {"warningHigh", 4000}, {"alarmHigh", 4500}});
/// ```
///
/// | setting                              | meaning                                                                                                   |
/// |--------------------------------------|-----------------------------------------------------------------------------------------------------------|
/// | `signal`                             | "tetherForce", "bodyPosition_earth[2]", "plant/tetherForce"; a triple is shown as three numbers. Behind "=" something calculated of signals, in a window: "= norm(bodyVelocity_earth)" |
/// | `style`                              | "dial" (default), "bar" (lies or stands, as there is space), "number", "led"                                |
/// | `minimum`, `maximum`                 | ends of the scale, in the unit of the signal. Default: limits of the table; without those the scale grows with the values |
/// | `alarmLow`, `warningLow`, `warningHigh`, `alarmHigh` | from where on a value is worth a look, or wrong; said by colour, sign and words. Default: none  |
/// | `hysteresis`                         | how far a value has to come back before a warning or alarm ends. Default: 1 % of the scale                  |
/// | `extremes`                           | true: marks of the smallest and largest value since reset. Default: false                                   |
///
/// What is beyond the limits of the table is an alarm without further settings. Values that are not renewed are grey, with their age. In a window whose plots are frozen it shows
/// the value of the time that is looked at. A signal that does not exist (yet) is a grey line that says so, and comes to life with it.
///
/// Without a window, values come by realTimeout(), and the signal is looked up in the table of the process (QPlcSignalIndexTable); it is inputSignalIndices().
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcGauge : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("Gauge"); }

    explicit QPlcGauge(QWidget *parent = nullptr);
    ~QPlcGauge() override;

    QString kind() const override { return typeName(); }
    QJsonObject settings() const override;
    /// Settings that are missing have their defaults from here on.
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    /// Shows the first one instead of the present one.
    bool addSignals(const QStringList &references) override;
    QSize sizeHint() const override;

public Q_SLOTS:
    void realTimeout(const QList<QPlcSignalList> &signalValues) override;

protected:
    void contextChanged() override;
    void showEvent(QShowEvent *event) override;
    void hideEvent(QHideEvent *event) override;
    void paintEvent(QPaintEvent *event) override;

private:
    void addStyleAction(const QString &text, const QString &style);
    void showSettings();
    void takeEdit();

    struct Private;
    std::unique_ptr<Private> d;
};
using QPlcGaugeFactory = QPlcWidgetFactoryOf<QPlcGauge>;
