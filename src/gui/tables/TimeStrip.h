// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QPointer>
#include <QtCore/QTimer>
#include <QtWidgets/QLabel>

class QPlcPanelContext;

namespace qplc {

/// A line that is there while values are not those of now, and says why: the window shows another
/// time, or a plant gives none any more.
class TimeStrip : public QLabel
{
    Q_OBJECT
public:
    explicit TimeStrip(QWidget *parent = nullptr);
    void setContext(QPlcPanelContext *context);

private:
    void renew();
    QString staleText() const;
    void say(const QString &text, const QColor &color);

    QPointer<QPlcPanelContext> m_context;
    QTimer m_timer;
};

}  // namespace qplc
