// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtWidgets/QWidget>

namespace qplc {

/// Stands for a panel whose type this program does not know; its settings stay in the layout.
class PanelPlaceholder : public QWidget
{
    Q_OBJECT
public:
    PanelPlaceholder(const QString &type, QWidget *parent);
    QString text() const { return m_text; }
    QSize minimumSizeHint() const override { return {80, 40}; }

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    QString m_text;
};

}  // namespace qplc
