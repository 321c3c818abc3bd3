// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "PlantSelection.h"
#include "PlantSummary.h"
#include "gui/panel/WindowContext.h"

#include <QtWidgets/QWidget>

namespace qplc {

/// What a recorder does, in words for people.
struct RecorderSummary
{
    Tone tone = Tone::Calm;
    bool isRecording = false;
    QString text;  // "14 kB/s", "not recording", "disk full"; empty: nothing is known
    QString more;  // sentences

    static RecorderSummary of(const messages::RecorderEntry &recorder);
};

/// Says in the bar below what the recorder of the selected plant does: "REC 14 kB/s". Its place is
/// kept while there is nothing to say.
class RecorderNotice : public QWidget
{
    Q_OBJECT
public:
    /// \param selection, context  outlive the notice
    RecorderNotice(const PlantSelection *selection, WindowContext *context, QWidget *parent = nullptr);

    const RecorderSummary &summary() const { return m_summary; }

    QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent *event) override;

private:
    void follow();
    int textLeft() const;

    const PlantSelection *m_selection;
    WindowContext *m_context;
    RecorderSummary m_summary;
};

}  // namespace qplc
