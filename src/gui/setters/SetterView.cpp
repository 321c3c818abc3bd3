// SPDX-License-Identifier: Apache-2.0
#include "SetterView.h"

#include "gui/models/ValueFormat.h"

#include <algorithm>

namespace qplc {

namespace {

constexpr struct
{
    const char *name;
    SetterView *(*create)(SetterTarget *target, QWidget *parent);
} styleRows[] = {{"number", createNumberView},       {"slider", createSliderView},       {"toggle", createToggleView},
                 {"momentary", createMomentaryView}, {"generator", createGeneratorView}, {"knob", createKnobView},
                 {"list", createChoiceView}};

}  // namespace

SetterView::SetterView(SetterTarget *target, QWidget *parent)
    : QWidget(parent)
    , m_target(target)
{
}

SetterView *SetterView::create(const QString &style, SetterTarget *target, QWidget *parent)
{
    return styleRows[std::max(0, styles().indexOf(style))].create(target, parent);
}

QStringList SetterView::styles()
{
    QStringList names;
    for (const auto &row : styleRows)
        names << QLatin1String(row.name);
    return names;
}

QString SetterView::actualText() const
{
    constexpr int digits = 5;
    if (target().isNumber())
        return target().reading(target().actualNumber(), digits);
    const QString value = valueText(target().actual(), target().signal().definition);
    return QStringLiteral("%1 %2").arg(value, target().unit()).trimmed();
}

}  // namespace qplc
