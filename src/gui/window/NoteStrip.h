// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "EntryStrip.h"
#include "PlantSelection.h"

#include <QtCore/QPointer>

namespace qplc {

/// Asks for a note: Enter sends it to the master of the plant that was selected when the strip
/// opened, Escape forgets it. The text stays until the master has it.
///
/// A plant that a program feeds has no master: then the note stays in the event log of the window.
class NoteStrip : public EntryStrip
{
    Q_OBJECT
public:
    /// \param selection, context  outlive the strip
    NoteStrip(PlantSelection *selection, WindowContext *context, QWidget *parent = nullptr);

    /// Shows the strip, with the keys in its field; or emits refused().
    void open();
    /// Why a note cannot be sent to a plant, for people; empty: it can.
    static QString obstacleOf(const Plant *plant);

Q_SIGNALS:
    void refused(const QString &sentence);

private:
    void accept() override;
    void leave() override;
    /// The text can be sent again.
    void fail(const QString &sentence);

    PlantSelection *m_selection;
    QPointer<Plant> m_plant;  // that the note is for
    QString m_plantName;      // empty: for the log of the window
    int m_command = 0;        // that was sent; 0: none
    QPointer<QWidget> m_focusBefore;
};

}  // namespace qplc
