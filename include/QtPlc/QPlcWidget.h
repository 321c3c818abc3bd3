// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "QPlcGuiGlobal.h"
#include "QPlcSignalIndexList.h"
#include "QPlcSignalList.h"

#include <QtCore/QJsonObject>
#include <QtCore/QStringList>
#include <QtWidgets/QWidget>

#include <memory>

class QPlcPanelContext;
class QPlcWidgetFactory;

namespace qplc {
class WindowContext;
}

/// A view of a plant that a Control Center shows in a panel: what QPlcSlaveNode is for a node, for a window.
///
/// ```cpp
/// class Compass : public QPlcWidget
/// {
/// public:
///     static QString typeName() { return QStringLiteral("Compass"); }
///     using QPlcWidget::QPlcWidget;
///     QString kind() const override { return typeName(); }
///
/// protected:
///     void contextChanged() override
///     {
///         connect(context(), &QPlcPanelContext::changed, this, QOverload<>::of(&QWidget::update));
///     }
///     void paintEvent(QPaintEvent *event) override;  // context()->shown("heading"), context()->theme()
/// };
///
/// controlCenter.addPanel<Compass>();
/// ```
///
/// A subclass draws what context() gives it. Its settings are JSON, so that people can save and open layouts
/// and undo what they did. People find its actions() in the menu of the panel and among the commands of the
/// window. A node that the program wires by hand brings values by realTimeout() instead. `docs/howto/write-a-panel.md`
/// is the whole way.
///
/// Threads: the thread of the window.
class QTPLC_GUI_EXPORT QPlcWidget : public QWidget
{
    Q_OBJECT
public:
    /// The first number that type() may return.
    static constexpr int UserType = 1000;

    explicit QPlcWidget(QWidget *parent = nullptr);
    ~QPlcWidget() override;

    /// Returns what layouts call this panel: the name of its factory, "Time plot". Override it.
    virtual QString kind() const { return {}; }
    /// Returns UserType or above in programs that count their kinds of panels, as the thesis does.
    /// 0: kind() says it.
    virtual int type() const { return 0; }

    /// Makes a factory known to the program, which owns it from now on. \return \a factory
    static QPlcWidgetFactory *registerFactory(QPlcWidgetFactory *factory);
    /// Returns the factory of a type; null when there is none.
    static QPlcWidgetFactory *factory(int type);
    /// Returns the factory of a kind; null when there is none.
    static QPlcWidgetFactory *factory(const QString &kind);
    /// Returns the factory of kind(), or of type(); null when there is none.
    virtual QPlcWidgetFactory *factory() const;

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

    /// Returns the window as this panel sees it: signals, their past, time, theme. Never null. Outside of
    /// a window it knows no plant.
    QPlcPanelContext *context() const;
    /// What all panels of a window share. For panels of QtPLC that do not keep to context() yet.
    qplc::WindowContext *windowContext() const;
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
    /// Called when the panel has come into a window: from now on context() knows plants.
    virtual void contextChanged() {}
    /// Returns what QPlcWidget saves, and \a own: for a subclass that overrides settings().
    QJsonObject settingsWith(const QJsonObject &own) const;
    /// Returns a setting of the panel, as its layout has it; \a defaultValue where the layout has none.
    QJsonValue setting(const QString &key, const QJsonValue &defaultValue = QJsonValue()) const;
    /// Sets a setting because a person wants it: an undo step, and saved in the layout.
    /// \param defaultValue  this value leaves the layout, as null does
    void setSetting(const QString &key, const QJsonValue &value, const QJsonValue &defaultValue = QJsonValue());
    /// \param title  empty: the name of the factory
    void setDefaultTitle(const QString &title);
    void setInputSignalIndices(const QPlcSignalIndexList &indices);
    void setOutputSignalIndices(const QPlcSignalIndexList &indices);
    void setInitialOutputSignals(const QPlcSignalList &signalValues);

private:
    struct Private;
    std::unique_ptr<Private> d;
};
