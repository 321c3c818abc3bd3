// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcWidget.h"
#include "QPlcWidgetFactoryOf.h"

/// Sets one signal by hand, and shows its actual value beside.
///
/// | style | |
/// |---|---|
/// | `number` | typed; sent once by Enter or *Set*, never while it is edited; Esc takes the typing back; Up, Down, Page up, Page down step by 1 % and 10 % of the range |
/// | `slider` | sent while it is dragged, at most 20 times a second, and always where it ends |
/// | `toggle` | on (`on`, 1 unless set) or off (neutral) |
/// | `momentary` | `pressed` (the maximum unless set) while the button is held; then neutral |
/// | `knob` | turned; sent once when the mouse lets go, or by Enter when keys or the wheel have turned it; Esc takes the turning back |
/// | `list` | one of the names that the values of the signal have in the table (`values`); sent once, as its number |
/// | `generator` | steps, ramps or a sine, a new value every 20 ms |
///
/// Values beyond the limits of the signal table become the limit, and the setter says so. A signal that a node writes has to be taken over first (*Take control*, Ctrl+T), and is given back by *Give
/// back* (Ctrl+B); what somebody holds has a frame, in every window. *Neutral* is `safe` of the table, else 0, else the limit nearest to 0. Momentary and generator set it when they end: also
/// when the panel is hidden, and, for a master that knows leases, when this window, its computer or the network is lost.
///
/// Settings: `signal` (a reference in text), `style`, and `minimum`, `maximum` within those of the table; `on`, `pressed`, `generator` as above. Nothing is written by applySettings().
class QTPLC_GUI_EXPORT QPlcSetter : public QPlcWidget
{
    Q_OBJECT
public:
    static QString typeName() { return QStringLiteral("Setter"); }

    explicit QPlcSetter(QWidget *parent = nullptr);
    ~QPlcSetter() override;

    QString kind() const override { return typeName(); }
    QJsonObject settings() const override;
    void applySettings(const QJsonObject &settings) override;
    QWidget *createSettingsEditor() override;
    QStringList shownSignals() const override;
    /// Sets the first of \a references from now on.
    bool addSignals(const QStringList &references) override;

protected:
    void contextChanged() override;
    void paintEvent(QPaintEvent *event) override;
    void showEvent(QShowEvent *event) override;

private:
    struct Private;
    std::unique_ptr<Private> d;
};

using QPlcSetterFactory = QPlcWidgetFactoryOf<QPlcSetter>;
