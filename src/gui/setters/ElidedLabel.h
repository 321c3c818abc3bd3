// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QLabel>

namespace qplc {

/// One line of text, or as many as it may have, that ends with an ellipsis where there is no room
/// for it; all of it is in the tool tip then.
class ElidedLabel : public QLabel
{
    Q_OBJECT
public:
    explicit ElidedLabel(QWidget *parent = nullptr);
    /// Also for those who cannot see it.
    void showText(const QString &text);
    void setColor(const QColor &color);
    /// Longer texts are wrapped before they are elided; 1: never.
    void setMostLines(int lines);
    bool isElided() const;
    int heightForWidth(int width) const override;
    QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;

private:
    QStringList linesFor(int width) const;
    void updateToolTip();

    int m_mostLines = 1;
};

}  // namespace qplc
