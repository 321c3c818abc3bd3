// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "BarButton.h"
#include "NoticeLine.h"
#include "PlantSelection.h"

namespace qplc {

/// Asks which plants STOP means while a person controls several: all of them, or one. To ask again
/// is the answer "all". Hidden while nothing is asked.
class StopQuestion : public NoticeLine
{
    Q_OBJECT
public:
    /// \param selection, context  outlive the line
    StopQuestion(PlantSelection *selection, WindowContext *context, QWidget *parent = nullptr);

    /// \param how  the person asked to stop, for those who are told of it
    void ask(const QString &how);

Q_SIGNALS:
    void answered(const QVector<qplc::Plant *> &plants, const QString &how);

private:
    void follow();
    void answer(const QVector<Plant *> &plants, const QString &how = QString());
    void addChoice(const QString &text, const QVector<Plant *> &plants, BarButton::Kind kind);

    PlantSelection *m_selection;
    QVector<Plant *> m_asked;
    QVector<BarButton *> m_buttons;
};

}  // namespace qplc
