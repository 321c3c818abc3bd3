// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// Flies a plant by keys, or by the axes of a gamepad: while a key is held, its signal has a value; else it is neutral (`safe` of the table, else 0, else the limit nearest to 0).
///
/// *Take control* (Ctrl+T) takes all of the signals at once from the node that writes them, *Give back* (Ctrl+B) gives them back; who has control stands above the keys, in large. Keys act
/// while the panel has the keyboard. It is a dead man's handle: when a key is released, the keyboard or the window goes elsewhere or the panel is hidden, its signal is neutral at once; when
/// this window, its computer or the network is lost, the master sets neutral and keeps it until somebody takes control or gives it back.
///
/// Axes act while they are armed, by the button of the panel or the lower one of the gamepad; what releases keys disarms them.
///
/// Settings:
/// ```json
/// {"keys": [{"key": "Left", "signal": "bodyControlYawSpeed", "value": -40}],
///  "axes": [{"axis": "LeftX", "signal": "bodyControlYawSpeed", "value": 90, "deadZone": 0.1, "expo": 0.3}]}
/// ```
/// Keys are named as in QKeySequence; axes are `LeftX`, `LeftY`, `RightX`, `RightY`, positive to the right and upwards. `deadZone` and `expo` (0 linear ... 1 cubic) may be left out.
class QTPLC_GUI_EXPORT QPlcKeyboardControl : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("Keyboard control"); }

    explicit QPlcKeyboardControl(QWidget *parent = nullptr);
    ~QPlcKeyboardControl() override;

    QString kind() const override { return typeName(); }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;

protected:
    void contextChanged() override;
    bool event(QEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void keyReleaseEvent(QKeyEvent *event) override;
    void mousePressEvent(QMouseEvent *event) override;
    void focusInEvent(QFocusEvent *event) override;
    void focusOutEvent(QFocusEvent *event) override;
    void showEvent(QShowEvent *event) override;
    void hideEvent(QHideEvent *event) override;
    void paintEvent(QPaintEvent *event) override;

private:
    struct Private;
    std::unique_ptr<Private> d;
};

using QPlcKeyboardControlFactory = QPlcWidgetFactoryOf<QPlcKeyboardControl>;
