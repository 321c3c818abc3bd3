// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gui/panel/WindowContext.h"

namespace qplc {

/// Keeps the values of a model, which has setDisplayTime(), at the time that the window shows, as long as the model lives.
template<typename Model>
void followDisplayTime(Model *model, WindowContext *context)
{
    TimeView *time = context->timeView();
    const auto show = [model, time] { model->setDisplayTime(time->displayTime()); };
    QObject::connect(time, &TimeView::displayTimeChanged, model, show);
    show();
}

}  // namespace qplc
