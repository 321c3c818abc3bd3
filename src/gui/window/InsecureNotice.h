// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "WindowContext.h"

#include <QtWidgets/QWidget>

class QLabel;

namespace qplc {

/// A line over the panels for as long as the window is connected to a master that listens to a network without security. It cannot be closed.
class InsecureNotice : public QWidget
{
    Q_OBJECT
public:
    /// \param context  outlives the notice
    explicit InsecureNotice(WindowContext *context, QWidget *parent = nullptr);

    /// Empty while there is nothing to say.
    QString text() const;

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    void listenTo(Plant *plant);
    void follow();

    WindowContext *m_context;
    QLabel *m_label;
};

}  // namespace qplc
