// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "PlantFixtures.h"
#include "QPlcNodeTable.h"
#include "SecurityFixtures.h"
#include "TableText.h"
#include "gui/models/NodeTableModel.h"
#include "gui/panel/WindowContext.h"
#include "gui/tables/EvictionQuestion.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QApplication>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QTreeView>

using namespace qplc;

namespace {

/// The nodes of a plant with a counter in the process of the master, and Echo outside of it.
class NodesPanel
{
public:
    explicit NodesPanel(const QPlcSecurity &security = {}, bool isCritical = false, const QString &query = {})
        : m_context(std::make_unique<WindowContext>())
    {
        master.setSecurity(security);
        master.setInterval(std::chrono::milliseconds(10));
        if (!master.addLocalNode(&counter) || !master.listen())
            qFatal("%s", qPrintable(master.errorString()));
        if (security.isNone()) {
            echo.setCritical(isCritical);
            if (!master.admit(echo, QStringLiteral("tcp")))
                qFatal("%s", qPrintable(echo.errorString()));
        }
        plant = m_context->plants()->add(QStringLiteral("127.0.0.1:%1%2").arg(master.serverPort()).arg(query),
                                         QStringLiteral("kite"));
        panel.setContext(m_context.get());
        panel.resize(700, 240);
        panel.show();
        view = panel.findChild<QTreeView *>();
        question = panel.findChild<EvictionQuestion *>();
    }
    ~NodesPanel()
    {
        echo.disconnectFromMaster();
        master.removeLocalNode(&counter);
    }
    QStringList names() const { return columnTexts(*view->model(), NodeTableModel::Name); }
    QString stateOf(const QString &name) const
    {
        return cellText(*view->model(), names().indexOf(name), NodeTableModel::State);
    }
    /// Goes to the row of a name, as the arrow keys do. \return false when it does not come
    bool goTo(const QString &name)
    {
        if (!waitUntil([&] { return names().contains(name); }))
            return false;
        view->setCurrentIndex(view->model()->index(names().indexOf(name), 0));
        return true;
    }
    QAction *action(const char *name) const { return panel.findChild<QAction *>(QLatin1String(name)); }
    /// What happens now if this row is evicted; empty: it cannot.
    QString questionAbout(const QString &name)
    {
        if (!goTo(name) || !action("evict")->isEnabled())
            return {};
        action("evict")->trigger();
        return question->findChild<QLabel *>()->text();
    }
    QPushButton *button(const char *name) const { return question->findChild<QPushButton *>(QLatin1String(name)); }
    bool isAsked() const { return question->isVisible(); }
    /// Presses the button that acts, as soon as it can be pressed.
    bool act()
    {
        return waitUntil([this] { return button("act")->isEnabled(); }) && isAsked() && (button("act")->click(), true);
    }

    TestMaster master{QPlcClock::realTime()};
    CounterNode counter;
    EchoNode echo;

private:
    std::unique_ptr<WindowContext> m_context;

public:
    Plant *plant;
    QPlcNodeTable panel;
    QTreeView *view;
    EvictionQuestion *question;
};

}  // namespace

// Evictions in the table of nodes: by people who see a node that misbehaves, and are in a hurry.
class tst_NodeEvictions : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { QPlcSignalIndexTable::setCurrent({}); }
    void nodeIsEvictedAndAdmitted();
    void evictedPersonHasARow();
    void questionNamesWhatHappens();
    void cancelIsWhereTheKeyboardIs();
    void secondClickDoesNothing();
    void questionEndsWhenItIsNotTrueAnyMore();
    void rowsThatCannotBeEvictedSayWhy();
    void roleWithoutTheRightIsNamed();
    void windowIsEvictedAsItsPerson();

private:
    SecurityFiles m_files;
};

void tst_NodeEvictions::nodeIsEvictedAndAdmitted()
{
    NodesPanel nodes;
    QVERIFY(nodes.goTo("Echo"));
    QCOMPARE(nodes.action("evict")->text(), QString("Evict 'Echo' ..."));
    QVERIFY(nodes.action("evict")->isVisible() && !nodes.action("admit")->isVisible());
    nodes.action("evict")->trigger();
    QCOMPARE(nodes.button("act")->text(), QString("Evict 'Echo'"));
    QVERIFY(nodes.act());
    QTRY_VERIFY(nodes.stateOf("Echo").startsWith("evicted by "));
    QVERIFY(QRegularExpression(" at [0-9:]{8}$").match(nodes.stateOf("Echo")).hasMatch());
    QCOMPARE(nodes.names().count("Echo"), 1);
    QCOMPARE(nodes.master.evictedNames(), QStringList{"Echo"});
    const QModelIndex row = nodes.view->model()->index(nodes.names().indexOf("Echo"), 0);
    QVERIFY(row.data(Qt::ForegroundRole).isValid());  // grey

    QVERIFY(nodes.goTo("Echo"));
    QCOMPARE(nodes.action("admit")->text(), QString("Admit 'Echo' ..."));
    QVERIFY(nodes.action("admit")->isEnabled() && !nodes.action("evict")->isVisible());
    nodes.action("admit")->trigger();
    QVERIFY(nodes.act());
    QTRY_COMPARE(nodes.master.evictedNames(), QStringList());
    QTRY_VERIFY(!nodes.stateOf("Echo").startsWith("evicted"));
}

void tst_NodeEvictions::evictedPersonHasARow()
{
    NodesPanel nodes;
    ScriptedTool tool("anna");
    QVERIFY(tool.greetAt(nodes.master.serverPort()));
    QVERIFY(nodes.master.evict("anna"));
    QTRY_VERIFY(nodes.names().contains("anna"));
    QVERIFY(nodes.stateOf("anna").startsWith("evicted by the master at "));
    QVERIFY(nodes.goTo("anna"));
    nodes.action("admit")->trigger();
    QVERIFY(nodes.act());
    QTRY_VERIFY(!nodes.names().contains("anna"));
}

void tst_NodeEvictions::questionNamesWhatHappens()
{
    {
        NodesPanel nodes;
        QCOMPARE(nodes.questionAbout("Echo"),
                 QString("kite: Evict 'Echo'? Its connections end at once, and it stays out until somebody admits it "
                         "again."));
        QVERIFY(nodes.master.startArmed());
        QTRY_VERIFY(nodes.plant->status().isRunning());
        QVERIFY(nodes.questionAbout("Echo").endsWith(
            "Cycles run on without it: its signals are held, then get their safe values."));
    }
    NodesPanel nodes({}, true);
    QVERIFY(nodes.questionAbout("Echo").endsWith("The node is critical: the plant does not start without it."));
    QVERIFY(nodes.master.startArmed());
    QTRY_VERIFY(nodes.plant->status().isRunning());
    QVERIFY(nodes.questionAbout("Echo").endsWith("Cycles run, and the node is critical: the plant stops safely now."));
    QVERIFY(nodes.act());
    QVERIFY(nodes.master.waitForState(QPlcMasterNode::SafeStop));
}

void tst_NodeEvictions::cancelIsWhereTheKeyboardIs()
{
    NodesPanel nodes;
    QApplication::setActiveWindow(&nodes.panel);
    QVERIFY(QTest::qWaitForWindowActive(&nodes.panel));
    nodes.view->setFocus();
    QVERIFY(nodes.goTo("Echo"));
    QTest::keyClick(nodes.view, Qt::Key_E, Qt::ControlModifier);
    QVERIFY(nodes.isAsked() && nodes.button("cancel")->hasFocus());
    QTest::keyClick(nodes.button("cancel"), Qt::Key_Return);
    QTest::keyClick(nodes.button("cancel"), Qt::Key_Space);
    QVERIFY(!nodes.isAsked() && nodes.view->hasFocus());
    QTest::keyClick(nodes.view, Qt::Key_E, Qt::ControlModifier);
    QVERIFY(nodes.isAsked());
    QTest::keyClick(nodes.button("cancel"), Qt::Key_Escape);
    QVERIFY(!nodes.isAsked() && nodes.view->hasFocus());
    QCOMPARE(nodes.master.evictedNames(), QStringList());
}

void tst_NodeEvictions::secondClickDoesNothing()
{
    NodesPanel nodes;
    QVERIFY(!nodes.questionAbout("Echo").isEmpty());
    QVERIFY(!nodes.button("act")->isEnabled());
    QTest::mouseClick(nodes.button("act"), Qt::LeftButton);
    QVERIFY(nodes.isAsked());
    QTRY_VERIFY(nodes.button("act")->isEnabled());
    QCOMPARE(nodes.master.evictedNames(), QStringList());
}

void tst_NodeEvictions::questionEndsWhenItIsNotTrueAnyMore()
{
    NodesPanel nodes;
    QVERIFY(!nodes.questionAbout("Echo").isEmpty());
    QVERIFY(nodes.master.startArmed());
    QTRY_VERIFY(!nodes.isAsked());  // cycles run now
    QVERIFY(!nodes.questionAbout("Echo").isEmpty());
    QVERIFY(nodes.master.evict("Echo"));
    QTRY_VERIFY(!nodes.isAsked());
    QVERIFY(nodes.goTo("Echo"));
    nodes.action("admit")->trigger();
    QVERIFY(nodes.isAsked());
    nodes.plant->close();
    QTRY_VERIFY(!nodes.isAsked());
}

void tst_NodeEvictions::rowsThatCannotBeEvictedSayWhy()
{
    NodesPanel nodes;
    const auto reason = [&](const QString &name) {
        return nodes.goTo(name) && !nodes.action("evict")->isEnabled() ? nodes.action("evict")->toolTip() : QString();
    };
    QCOMPARE(nodes.action("evict")->toolTip(), QString("Select a node or person."));
    QTRY_VERIFY(nodes.plant->ownNode());
    QCOMPARE(reason("Master"), QString("This is the master."));
    QCOMPARE(reason("Counter"), QString("This node runs in the process of the master."));
    QTRY_COMPARE(reason(nodes.plant->ownNode()->info.name), QString("This is you; somebody else has to evict you."));
    nodes.plant->close();
    QTRY_COMPARE(reason("Echo"), QString("There is no connection to the master."));
}

void tst_NodeEvictions::roleWithoutTheRightIsNamed()
{
    (void)m_files.bert();
    NodesPanel nodes(QPlcSecurity::preSharedKeys(m_files.masterKeys()), false,
                     QStringLiteral("?keys=") + m_files.path("bert.ini"));
    nodes.echo.setSecurity(m_files.echo());
    QVERIFY2(nodes.master.admit(nodes.echo, "tcp"), qPrintable(nodes.echo.errorString()));
    QVERIFY(nodes.goTo("Echo"));
    QTRY_COMPARE(nodes.action("evict")->toolTip(),
                 QString("Your role Observer may not do this; it needs the role Operator or Engineer."));
    QVERIFY(!nodes.action("evict")->isEnabled());
}

/// Its node only listens: the commands come over another connection, with the name of the person.
void tst_NodeEvictions::windowIsEvictedAsItsPerson()
{
    NodesPanel nodes;
    ScriptedNode window("bert@lab-4711");
    window.onlyListen();
    window.cyclic = "tcp";
    QVERIFY(window.registerAt(nodes.master.serverPort()));
    ScriptedTool tool("bert@lab");
    QVERIFY(tool.greetAt(nodes.master.serverPort()));
    QVERIFY(nodes.questionAbout("bert@lab-4711").startsWith("kite: Evict 'bert@lab'? "));
    QVERIFY(nodes.act());
    QTRY_COMPARE(nodes.master.evictedNames(), QStringList{"bert@lab"});
    QTRY_VERIFY(!tool.control.isConnected());
}

QTEST_MAIN(tst_NodeEvictions)
#include "tst_NodeEvictions.moc"
