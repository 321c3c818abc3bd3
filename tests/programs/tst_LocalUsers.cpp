// SPDX-License-Identifier: Apache-2.0
#include "Program.h"

#include <QtTest/QtTest>

#include <memory>
#include <unistd.h>

// A master and a node with a local link as programs of two users.
class tst_LocalUsers : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void programsOfOneUserRunTogether_data();
    void programsOfOneUserRunTogether();
    void aNodeOfRootDoesNotLinkWithAMasterOfAnotherUser();
    void aNodeOfAnotherUserGetsNoMemory();

private:
    static std::unique_ptr<Program> run(const QString &user, QStringList arguments)
    {
        arguments.prepend(QStringLiteral(QTPLC_PROGRAMS "/safe_plant"));
        return std::make_unique<Program>(
            QStringLiteral("setpriv"),
            QStringList{"--reuid=" + user, "--regid=" + user, "--clear-groups", "--inh-caps=-all"} + arguments);
    }
    /// A master of one user, and a node of another one that has been refused.
    /// \return what the node says of it
    QString refusal(const QString &userOfMaster, const QString &userOfNode)
    {
        const std::unique_ptr<Program> master = run(userOfMaster, {"master", "0", "1"});
        if (!master->waitForOutput("port "))
            return "no master: " + master->errors();
        const QString port = master->output().section("port ", 1).section('\n', 0, 0);
        const std::unique_ptr<Program> node = run(userOfNode, {"node", "A", port, "300", "plain", "local"});
        if (!node->waitForOutput("error "))
            return "not refused: " + node->output() + node->errors();
        if (node->output().contains("registered") || master->output().contains("node A"))
            return "registered: " + node->output() + master->output();
        return node->output();
    }
    const QString root = "0";
    const QString nobody = "65534";
};

void tst_LocalUsers::initTestCase()
{
    if (::geteuid() != 0)
        QSKIP("only root can run programs of two users");
    const Outcome outcome = runProgram("setpriv", {"--reuid=65534", "test", "-x", QTPLC_PROGRAMS "/safe_plant"});
    if (outcome.exitCode != 0)
        QSKIP("other users may not run the programs of this build");
}

void tst_LocalUsers::programsOfOneUserRunTogether_data()
{
    QTest::addColumn<QString>("user");
    QTest::newRow("root") << root;
    QTest::newRow("nobody") << nobody;
}

void tst_LocalUsers::programsOfOneUserRunTogether()
{
    QFETCH(QString, user);
    const std::unique_ptr<Program> master = run(user, {"master", "0", "1"});
    QVERIFY2(master->waitForOutput("port "), qPrintable(master->errors()));
    const QString port = master->output().section("port ", 1).section('\n', 0, 0);
    const std::unique_ptr<Program> node = run(user, {"node", "A", port, "300", "plain", "local"});
    QVERIFY2(node->waitForOutput("runs"), qPrintable(node->output() + node->errors()));
}

void tst_LocalUsers::aNodeOfRootDoesNotLinkWithAMasterOfAnotherUser()
{
    const QString text = refusal(nobody, root);
    QVERIFY2(text.contains("the master runs as user 65534, and this node as user 0"), qPrintable(text));
}

void tst_LocalUsers::aNodeOfAnotherUserGetsNoMemory()
{
    const QString text = refusal(root, nobody);
    QVERIFY2(text.contains("the master runs as user 0, and this node as user 65534"), qPrintable(text));
}

QTEST_GUILESS_MAIN(tst_LocalUsers)
#include "tst_LocalUsers.moc"
