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

/// Base of panels. A panel is a view of a plant in a Control Center.
///
/// \code
/// class Compass : public QPlcWidget
/// {
/// public:
///     static QString typeName() { return "Compass"; }
///     using QPlcWidget::QPlcWidget;
///     QString kind() const override { return typeName(); }
///
/// protected:
///     void contextChanged() override
///     {
///         connect(context(), &QPlcPanelContext::changed, this, QOverload<>::of(&QWidget::update));
///     }
///     void paintEvent(QPaintEvent *) override
///     {
///         QPainter painter(this);
///         painter.setPen(context()->theme().text);
///         const QString heading = QPlcPanelContext::text(context()->shown("heading"));
///         painter.drawText(rect(), Qt::AlignCenter, heading);
///     }
/// };
/// QPlcControlCenter controlCenter;
/// controlCenter.addPanel<Compass>();
/// \endcode
///
/// A subclass draws what context() gives it. Its settings are JSON, so that people can save and
/// open layouts and undo changes. People find its actions() in the menu of the panel and among the
/// commands of the window. If the program wires a node by hand, realTimeout() brings the values
/// instead. docs/howto/write-a-panel.md shows a panel step by step.
///
/// \threadsafe no: use it in the thread of the window
///
/// \ingroup panels
class QTPLC_GUI_EXPORT QPlcWidget : public QWidget
{
    Q_OBJECT
public:
    /// Smallest number that type() may return.
    static constexpr int UserType = 1000;

    /// Makes a panel outside of a window: context() knows no plant.
    /// \param parent  owns the panel, if given
    explicit QPlcWidget(QWidget *parent = nullptr);
    /// Destroys the panel and its context().
    ~QPlcWidget() override;

    /// Returns the name of this kind of panel in layouts, which is the name of its factory: "Time
    /// plot". Override it; the default is empty.
    virtual QString kind() const { return {}; }
    /// Returns UserType or more in programs that number their kinds of panels, as the thesis does.
    /// 0 (the default): kind() names it.
    virtual int type() const { return 0; }

    /// Makes a factory known to the program, which owns it from now on. A second call with the same
    /// factory does nothing.
    /// \return \a factory
    static QPlcWidgetFactory *registerFactory(QPlcWidgetFactory *factory);
    /// Returns the registered factory with a type(); null if there is none, and for 0.
    static QPlcWidgetFactory *factory(int type);
    /// Returns the registered factory with a name(); null if there is none.
    static QPlcWidgetFactory *factory(const QString &kind);
    /// Returns the registered factory of kind(), or of type() if kind() is empty; null if there is
    /// none.
    virtual QPlcWidgetFactory *factory() const;

    /// Returns the text above the panel: the title that a person has set, else defaultTitle().
    QString title() const;
    /// Sets the title of the panel, as a person does. It is part of settings().
    /// \param title  empty: defaultTitle()
    void setTitle(const QString &title);
    /// Returns what the panel shows, in a few words: "power, tetherLength". Without
    /// setDefaultTitle() it is the title of the factory.
    QString defaultTitle() const;

    /// Returns the plant that names of signals without a plant refer to; empty: the selected plant
    /// of the window. It is part of settings(), with the key "plant".
    QString pinnedPlant() const;
    /// Sets the plant that names of signals without a plant refer to; empty: the selected plant of
    /// the window.
    void setPinnedPlant(const QString &plant);
    /// Returns the signals and formulas that the panel shows or writes, in the form of
    /// addSignals(). The window shows above the panel to which plants they belong. Empty (the
    /// default): the panel shows its plant as a whole.
    virtual QStringList shownSignals() const { return {}; }
    /// Returns true if the panel shows all plants of the window at the same time, such as an event
    /// log; the panel then shows itself which entry belongs to which plant. Default false.
    virtual bool showsAllPlants() const { return false; }

    /// Returns all settings of the panel for a layout, without its present values. Keys that
    /// applySettings() did not know are part of it.
    virtual QJsonObject settings() const;
    /// Applies settings that settings() has returned, of this panel or another one. A missing key
    /// has its default, so that undo restores the former state. Emits no settingsEdited().
    virtual void applySettings(const QJsonObject &settings);
    /// Returns an editor that the window opens over the panel; null (the default): the panel has no
    /// settings. The caller owns it.
    virtual QWidget *createSettingsEditor() { return nullptr; }

    /// Shows more signals, for example because a person has dropped them on the panel.
    /// \param references  "kite.elevation", "kite.position[2]", "plant/winch.speed"
    /// \return false (the default) if the panel can show none of them
    virtual bool addSignals(const QStringList &references);

    /// Returns the window as this panel sees it: signals, their history, time, theme. Never null;
    /// the panel owns it. Outside of a window it knows no plant.
    QPlcPanelContext *context() const;
    /// Connects the panel with a window and calls contextChanged(). The window calls it once,
    /// before or after applySettings().
    void setContext(qplc::WindowContext *context);

    /// Returns the signals that the panel wants in realTimeout().
    QPlcSignalIndexList inputSignalIndices() const;
    /// Returns the signals that the panel writes through a wired node.
    QPlcSignalIndexList outputSignalIndices() const;
    /// Returns the values of outputSignalIndices() at the begin of a phase.
    QPlcSignalList initialOutputSignals() const;

public Q_SLOTS:
    /// Receives values of a wired node, at the rate of the window. The default does nothing.
    /// \param signalValues  values of all cycles since the last call, oldest first
    virtual void realTimeout(const QList<QPlcSignalList> &signalValues);

Q_SIGNALS:
    /// Emitted when a person wants to see signals in another panel.
    /// \param references  as in addSignals()
    /// \param typeName  name of the factory of that panel: "Time plot", "Gauge", "Value table"
    void showRequested(const QStringList &references, const QString &typeName);
    /// Emitted when title() has changed.
    void titleChanged();
    /// Emitted when pinnedPlant() has changed.
    void pinnedPlantChanged();
    /// Emitted when a person has changed the settings. The window makes an undo step of it.
    void settingsEdited();
    /// Emitted by setInputSignalIndices().
    void inputSignalIndicesChanged();
    /// Emitted by setOutputSignalIndices().
    void outputSignalIndicesChanged();
    /// Emitted by setInitialOutputSignals().
    void initialOutputSignalsChanged();
    /// Emit it to write signals of outputSignalIndices() through a wired node.
    void sendNewOutputSignals(const QPlcSignalList &signalValues);

protected:
    /// Called when the panel has been put into a window: context() knows plants from now on. The
    /// default does nothing.
    virtual void contextChanged() {}
    /// Returns the settings of QPlcWidget together with \a own, for a subclass that overrides
    /// settings(). A key of \a own wins.
    QJsonObject settingsWith(const QJsonObject &own) const;
    /// Returns a setting of the panel.
    /// \param defaultValue  result if the layout does not have the key
    QJsonValue setting(const QString &key, const QJsonValue &defaultValue = QJsonValue()) const;
    /// Sets a setting because a person wants it: it is drawn, saved in the layout, and emits
    /// settingsEdited().
    /// \param value  null or \a defaultValue removes the key from the layout
    /// \param defaultValue  value of a missing key
    void setSetting(const QString &key, const QJsonValue &value, const QJsonValue &defaultValue = QJsonValue());
    /// Sets what the panel shows, in a few words.
    /// \param title  empty: the title of the factory
    void setDefaultTitle(const QString &title);
    /// Sets the signals that the panel wants in realTimeout().
    void setInputSignalIndices(const QPlcSignalIndexList &indices);
    /// Sets the signals that the panel writes through a wired node.
    void setOutputSignalIndices(const QPlcSignalIndexList &indices);
    /// Sets the values of the outputs at the begin of a phase.
    void setInitialOutputSignals(const QPlcSignalList &signalValues);

private:
    struct Q_DECL_HIDDEN Private;
    std::unique_ptr<Private> d;
};
