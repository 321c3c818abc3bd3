// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QToolButton>

namespace qplc {

/// A small square button in a title or a tab: 20 px, or as large as styles for fingers want it.
class TitleButton : public QToolButton
{
    Q_OBJECT
public:
    explicit TitleButton(QWidget *parent = nullptr);

    /// [px] in the style of \a widget
    static int sizeIn(const QWidget *widget);

protected:
    void changeEvent(QEvent *event) override;
};

}  // namespace qplc
