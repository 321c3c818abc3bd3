// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"
#include "QPlcSignalIndexList.h"
#include "QPlcSignalList.h"

#include <QtCore/QJsonObject>
#include <QtCore/QStringList>
#include <QtWidgets/QWidget>

#include <memory>

class QPlcWidgetFactory;

namespace qplc {
class WindowContext;
}

/// A view of a plant that a Control Center shows in a panel: what QPlcSlaveNode is for a node, for a window.
///
/// A subclass says which signals it reads and writes, gets their values in realTimeout(), and gives its settings as JSON, so that layouts can be saved, restored, and edited with undo.
/// Its actions() are found by people in the menu of the panel and among the commands of the window.
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcWidget : public QWidget
{
    Q_OBJECT
public:
    enum Type {
        Gauge,
        TimePlot,
        XyPlot,
        Setter,
        ValueTable,
        NodeTable,
        EventLog,
        JitterHistogram,
        WindWindow,
        View3D,
        SignalTree,
        KeyboardControl,
        UserType = 1000
    };

    explicit QPlcWidget(QWidget *parent = nullptr);
    ~QPlcWidget() override;

    /// A value of Type, or UserType and above.
    virtual int type() const = 0;

    /// Makes a factory known to the program, which owns it from now on. \return \a factory
    static QPlcWidgetFactory *registerFactory(QPlcWidgetFactory *factory);
    /// The factory of a type; null when there is none.
    static QPlcWidgetFactory *factory(int type);
    /// The factory with this name; null when there is none.
    static QPlcWidgetFactory *factory(const QString &name);
    virtual QPlcWidgetFactory *factory() const { return factory(type()); }

    /// What stands above the panel: the title that a person gave it, else defaultTitle().
    QString title() const;
    /// \param title  empty: defaultTitle()
    void setTitle(const QString &title);
    /// What the panel shows in a few words: "power, tetherLength"; the name of the factory while setDefaultTitle() was not called.
    QString defaultTitle() const;

    /// The plant that names of signals without a plant mean; empty: the one that is selected in the window. Part of settings(), with the key "plant".
    QString pinnedPlant() const;
    void setPinnedPlant(const QString &plant);
    /// Signals and formulas that the widget shows or writes, as in addSignals(): the window says above the panel of which plants they are. Empty: those of the plant of the panel as a whole.
    virtual QStringList shownSignals() const { return {}; }
    /// Whether the widget shows all plants of the window at the same time, as an event log: it says itself what belongs to which.
    virtual bool showsAllPlants() const { return false; }

    /// Everything that makes this widget what it is, but for what it shows at the moment. Keys that applySettings() did not know are part of it.
    virtual QJsonObject settings() const;
    /// Takes on what settings() gave, of this widget or another one. In a panel a key that is missing is a default, so that an undo step brings back what was.
    virtual void applySettings(const QJsonObject &settings);
    /// What the toothed wheel opens, over the widget; null: it has no settings. The caller owns it.
    virtual QWidget *createSettingsEditor() { return nullptr; }

    /// Shows signals in addition, when a person drops them here. \param references  "kite.elevation", "kite.position[2]", "plant/winch.speed"
    /// \return false: it has no use for any of them
    virtual bool addSignals(const QStringList &references);

    /// What the panels of the window share; null outside of one. For the panels of QtPLC itself.
    qplc::WindowContext *context() const;
    /// Called once by the window, before or after applySettings().
    void setContext(qplc::WindowContext *context);

    /// Signals that the widget wants in realTimeout().
    QPlcSignalIndexList inputSignalIndices() const;
    /// Signals that the widget writes.
    QPlcSignalIndexList outputSignalIndices() const;
    /// Values of what it writes, when a phase begins.
    QPlcSignalList initialOutputSignals() const;

public Q_SLOTS:
    /// The values of all cycles since the last call, oldest first.
    virtual void realTimeout(const QList<QPlcSignalList> &signalValues);

Q_SIGNALS:
    /// A person wants to see signals in another panel. \param typeName  of its factory: "Time plot", "Gauge", "Value table"
    void showRequested(const QStringList &references, const QString &typeName);
    void titleChanged();
    void pinnedPlantChanged();
    /// A person has changed the settings: worth an undo step.
    void settingsEdited();
    void inputSignalIndicesChanged();
    void outputSignalIndicesChanged();
    void initialOutputSignalsChanged();
    void sendNewOutputSignals(const QPlcSignalList &signalValues);

protected:
    /// There is a context() now.
    virtual void contextChanged() {}
    /// \param title  empty: the name of the factory
    void setDefaultTitle(const QString &title);
    void setInputSignalIndices(const QPlcSignalIndexList &indices);
    void setOutputSignalIndices(const QPlcSignalIndexList &indices);
    void setInitialOutputSignals(const QPlcSignalList &signalValues);

private:
    struct Private;
    std::unique_ptr<Private> d;
};
