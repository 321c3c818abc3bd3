// SPDX-License-Identifier: Apache-2.0
#include "NodeFixtures.h"
#include "node/NodeRegistry.h"

#include <QtTest/QtTest>

class tst_NodeRegistry : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void oneNodeTooManyIsRefusedWithTheLimit();
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

QTEST_GUILESS_MAIN(tst_NodeRegistry)
#include "tst_NodeRegistry.moc"
