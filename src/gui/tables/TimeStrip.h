// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QLabel>

namespace qplc {

class WindowContext;

/// A line that is there while a window shows another time than now, and says which.
class TimeStrip : public QLabel
{
    Q_OBJECT
public:
    explicit TimeStrip(QWidget *parent = nullptr);
    void setContext(WindowContext *context);

private:
    using QLabel::show;
    void show(WindowContext *context);
};

}  // namespace qplc
