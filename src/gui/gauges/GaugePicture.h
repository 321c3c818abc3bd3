// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "GaugeScale.h"
#include "GaugeSettings.h"
#include "gui/models/SiPrefix.h"

namespace qplc {

/// What a gauge looks like at a moment: texts and numbers that only have to be drawn. A value type.
struct GaugePicture
{
    /// One number, or one of a triple.
    struct Value
    {
        double number = 0.0;
        QString text;
        std::optional<double> minimum;  // since reset; empty: not shown
        std::optional<double> maximum;
    };
    /// A part of the scale that is not normal.
    struct Band
    {
        double begin;
        double end;
        AlarmState::Level level;
    };

    GaugeStyle style = GaugeStyle::Dial;
    QString message;  // what is missing; then nothing else is shown
    QString name;
    bool showsName = true;  // false where a title says what it is
    SiPrefix prefix;        // of the unit; numbers, scale and bands are in the unit of the table, texts have the prefix
    QString widestUnit;     // sets the size of letters where it is longer than the unit
    QString status;         // "stale 3.2 s", "▲ High"; empty when all is well
    QVector<Value> values;
    QString widest;  // the widest text of a value: figures end where it ends
    QString sizing;  // sets the size of letters where it is wider than the widest text
    GaugeScale scale;
    int decimals = 0;       // of texts
    bool isSteady = false;  // texts have so many digits that count, whatever their size
    QVector<Band> bands;
    AlarmState::Level level = AlarmState::Normal;
    bool isTrusted = true;
    bool isBoolean = false;

    /// With its prefix, without its unit.
    QString text(double number) const;
    QString tickText(double tick) const;
    /// One line for those who hear it.
    QString spoken() const;
};

/// Whether nobody could tell them apart: pointers that differ by less than a pixel are the same,
/// and numbers that are texts only do not count.
bool looksLike(const GaugePicture &a, const GaugePicture &b);

/// In front of a negative number.
const QChar minusSign(0x2212);
/// What stands where there is no value.
inline QString noValueText()
{
    return QStringLiteral("–");
}
/// The parts of a scale beyond limits.
QVector<GaugePicture::Band> bandsOf(const AlarmLimits &limits, const GaugeScale &scale);

}  // namespace qplc
