// SPDX-License-Identifier: Apache-2.0
#include "NodeFixtures.h"
#include "node/cycle/NodeRegistry.h"
#include "node/session/GoneNodes.h"

#include <QtTest/QtTest>

class tst_NodeRegistry : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void oneNodeTooManyIsRefusedWithTheLimit();
    void onlyTheLastRemovedNodesAreRemembered();
};

void tst_NodeRegistry::oneNodeTooManyIsRefusedWithTheLimit()
{
    qplc::NodeRegistry registry(testTable());
    qplc::NodeDeclaration declaration;
    qplc::Refusal refusal;
    for (int i = 0; i < qplc::NodeRegistry::MaximumNodes; ++i) {
        declaration.name = QStringLiteral("node %1").arg(i);
        QVERIFY2(registry.admit(declaration, &refusal), qPrintable(refusal.text));
    }
    declaration.name = QStringLiteral("Winch");
    QVERIFY(!registry.admit(declaration, &refusal));
    QCOMPARE(refusal.error, QString("TooManyNodes"));
    QCOMPARE(refusal.text, QString("node 'Winch' would be number 1001; a master serves at most 1000"));
    registry.remove(registry.nodes().front());
    QVERIFY(registry.admit(declaration, &refusal));
}

void tst_NodeRegistry::onlyTheLastRemovedNodesAreRemembered()
{
    qplc::GoneNodes gone;
    for (quint16 id = 0; id < 300; ++id)
        gone.add({id, QStringLiteral("node %1").arg(id), id % 2 == 1});
    QVERIFY(!gone.find(43));
    QVERIFY(gone.find(44));
    QCOMPARE(gone.find(299)->name, QString("node 299"));
    QVERIFY(gone.find(299)->isListener);
    gone.add({299, QStringLiteral("another of this number"), false});
    QCOMPARE(gone.find(299)->name, QString("another of this number"));
    gone.clear();
    QVERIFY(!gone.find(299));
}

QTEST_GUILESS_MAIN(tst_NodeRegistry)
#include "tst_NodeRegistry.moc"
