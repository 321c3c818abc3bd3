// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "GaugePicture.h"
#include "QPlcPanelContext.h"
#include "QPlcSignalList.h"
#include "formulas/SignalReference.h"
#include "gui/models/SteadyPrefix.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QPointer>
#include <QtCore/QTimer>

#include <optional>

namespace qplc {

/// Makes the picture of a gauge out of a signal, or of something calculated of signals: of a plant
/// of the window, at the time that the window shows, or of the values that a program gives.
///
/// Pointers move with every update, texts ten times a second. Nothing is done between
/// setActive(false) and setActive(true); smallest and largest values lose nothing meanwhile, as
/// they come from the store.
class GaugeFeed : public QObject
{
    Q_OBJECT
public:
    explicit GaugeFeed(QObject *parent = nullptr);

    void setContext(QPlcPanelContext *context);
    void setSettings(const GaugeSettings &settings);
    /// Whether the name of the signal is part of the picture.
    void setNameShown(bool isShown);
    void setActive(bool isActive);
    /// The values of a program, where there is no window. \param index  in the table of the process
    void add(const QList<QPlcSignalList> &batch, QPlcSignalIndex index);
    /// Of the panel: DrawNow renews the texts.
    bool eventFilter(QObject *panel, QEvent *event) override;
    /// Smallest and largest values begin anew.
    void reset();

    const GaugePicture &picture() const { return m_picture; }
    /// What the table says of the signal; an empty name when it is not there.
    const QPlcSignalDefinition &definition() const { return m_definition; }

    static constexpr int TextPause = 100;   // [ms]
    static constexpr int MostElements = 6;  // that are shown side by side

Q_SIGNALS:
    /// There is something new to draw.
    void changed();

private:
    struct Extremes
    {
        double minimum;  // NaN before the first value
        double maximum;
    };
    enum class Texts { Renew, WhenDue };

    void resolve();
    void lookUp();
    void begin();
    void refresh(Texts texts);
    void show(const GaugePicture &picture);
    void showSignal(GaugePicture *picture, bool hasNewTexts);
    void showValue(GaugePicture *picture, const QPlcValue &value, bool hasNewTexts);
    void judge(GaugePicture *picture, bool isPast);
    QString missingText() const;
    bool hasOpenEnd() const;
    QString openEndText() const;
    void choosePrefix(GaugePicture *picture, bool hasNewTexts);
    void showTexts(GaugePicture *picture, const QPlcValue &value, bool hasNewTexts);
    QString valueText(const GaugePicture &picture, double number) const;
    QPlcValue givenValue() const;
    void extendExtremes();
    void include(int element, double minimum, double maximum);
    int elements() const;
    GaugeScale scale() const;
    AlarmLimits limits() const;
    bool isBoolean() const;

    QPointer<QPlcPanelContext> m_context;
    GaugeSettings m_settings;
    SignalReference m_reference;  // of the settings; invalid for formulas
    QString m_referenceError;
    QPlcPanelContext::Signal m_signal;  // in a window; its value may be old
    QVector<QPlcPast> m_pasts;          // of its elements
    QPlcSignalDefinition m_definition;
    QPlcValue m_value;  // what a program gave
    QVector<AlarmState> m_alarms;
    QVector<Extremes> m_extremes;
    QPlcPast::Row m_seen = 0;    // rows before it are in the extremes
    QPlcPast::Time m_since = 0;  // rows before it do not count
    GaugeScale m_grownScale;
    SteadyPrefix m_prefix;  // where nothing says how large the number may become
    QString m_widest;
    GaugePicture m_picture;
    QTimer m_textTimer;
    QElapsedTimer m_sinceTexts;
    bool m_showsName = true;
    bool m_isActive = false;
};

}  // namespace qplc
