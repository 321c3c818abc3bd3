// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ManualBindings.h"
#include "gui/panel/SettingsEditor.h"

#include <functional>

class QGridLayout;
class QVBoxLayout;

class QPlcPanelContext;

namespace qplc {

/// What keys and axes do, row by row; each change applies at once.
class KeyMapEditor : public SettingsEditor
{
    Q_OBJECT
public:
    /// \param plants  whose signals are offered; null: none
    KeyMapEditor(const ManualBindings &bindings, QPlcPanelContext *context, QWidget *parent = nullptr);

Q_SIGNALS:
    void edited(const qplc::ManualBindings &bindings);

private:
    void rebuild();
    void addKeyRow(QGridLayout *grid, int place);
    void addAxisRow(QGridLayout *grid, int place);
    // \a signal, \a number: where the value is now, as rows come and go
    void addSignalField(QGridLayout *grid, int row, int column, const std::function<SignalReference &()> &signal);
    void addNumber(QGridLayout *grid, int row, int column, const QString &name, const std::function<double &()> &number,
                   double smallest, double largest);
    void addRemove(QGridLayout *grid, int row, int column, const std::function<void()> &remove);
    void addNote(QGridLayout *grid, const QString &text);
    void addButton(const QString &text, const std::function<void()> &add);
    void changed() { Q_EMIT edited(m_bindings); }

    ManualBindings m_bindings;
    QPlcPanelContext *m_context;
    QVBoxLayout *m_column;
    QWidget *m_content = nullptr;
};

}  // namespace qplc
