// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BarButton.h"

class QLabel;

namespace qplc {

/// A line over the panels that says one thing until it is closed; hidden while it has nothing to say.
class HintLine : public QWidget
{
    Q_OBJECT
public:
    explicit HintLine(WindowContext *context, QWidget *parent = nullptr);

    /// Empty: closes the line.
    void showText(const QString &text);
    QString text() const;

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    WindowContext *m_context;
    QLabel *m_label;
};

}  // namespace qplc
