// SPDX-License-Identifier: Apache-2.0
#include "SetterView.h"

#include "ChoiceView.h"
#include "GeneratorView.h"
#include "KnobView.h"
#include "MomentaryView.h"
#include "NumberView.h"
#include "SliderView.h"
#include "ToggleView.h"

namespace qplc {

SetterView::SetterView(SetterTarget *target, QWidget *parent)
    : QWidget(parent)
    , m_target(target)
{
}

SetterView *SetterView::create(const QString &style, SetterTarget *target, QWidget *parent)
{
    switch (styles().indexOf(style)) {
    case 1:
        return new SliderView(target, parent);
    case 2:
        return new ToggleView(target, parent);
    case 3:
        return new MomentaryView(target, parent);
    case 4:
        return new GeneratorView(target, parent);
    case 5:
        return new KnobView(target, parent);
    case 6:
        return new ChoiceView(target, parent);
    default:
        return new NumberView(target, parent);
    }
}

QStringList SetterView::styles()
{
    return {QStringLiteral("number"),    QStringLiteral("slider"),    QStringLiteral("toggle"),
            QStringLiteral("momentary"), QStringLiteral("generator"), QStringLiteral("knob"),
            QStringLiteral("list")};
}

}  // namespace qplc
