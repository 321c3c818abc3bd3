// SPDX-License-Identifier: Apache-2.0
#include "CyclicHub.h"
#include "LocalLink.h"
#include "LocalName.h"
#include "LocalTransport.h"
#include "PeerUser.h"
#include "TransportKind.h"
#include "protocol/messages/Field.h"
#include "protocol/messages/Vocabulary.h"

namespace qplc {

/// Memory that master and node share on one machine.
class LocalKind final : public TransportKind
{
public:
    QString name() const override { return QStringLiteral("local"); }
    /// Who may open the memory may look into both programs anyway.
    bool isSealed() const override { return false; }
    bool readPlace(const QString &place, const QString &text, QHostAddress *address, quint16 *port,
                   QString *error) const override;
    QString placeText(const QHostAddress &, quint16 port) const override { return QString::number(port); }
    std::unique_ptr<HubTransport> makeHubTransport() const override { return std::make_unique<LocalTransport>(); }
    bool admits(const CyclicHub &hub, const Newcomer &node, ChannelError *error) const override;
    std::unique_ptr<HubPeer> makePeer(const CyclicHub &hub, const Newcomer &node, QJsonObject *answer,
                                      ChannelError *error) const override;
    bool finishLink(const ControlEnds &ends, const QJsonObject &answer, std::unique_ptr<CyclicLink> *link,
                    QString *error) const override;

private:
    /// What a master says in Registered.
    struct Answer : LocalPaths
    {
        static constexpr auto fields = std::make_tuple(messages::field("channel", &LocalPaths::channel),
                                                       messages::field("doorbell", &LocalPaths::doorbell),
                                                       messages::field("pipe", &LocalPaths::pipe));
    };
};

std::unique_ptr<const TransportKind> makeLocalKind()
{
    return std::make_unique<LocalKind>();
}

/// A name of a master, or a port. The host that others name is this one.
bool LocalKind::readPlace(const QString &place, const QString & /*text*/, QHostAddress *address, quint16 *port,
                          QString *error) const
{
    QString name = place;
    for (const QLatin1String host : {QLatin1String("127.0.0.1:"), QLatin1String("localhost:")})
        name.remove(0, name.startsWith(host) ? host.size() : 0);
    bool isNumber = false;
    *address = QHostAddress(QHostAddress::LocalHost);
    *port = name.toUShort(&isNumber);
    if (!isNumber)
        *port = LocalName::portOf(name, error);
    else if (*port == 0)
        *error = QStringLiteral("'%1' is not a valid port; use 1 ... 65535").arg(name);
    return *port != 0;
}

bool LocalKind::admits(const CyclicHub &, const Newcomer &node, ChannelError *error) const
{
    if (node.address.isLoopback())
        return true;
    *error = {messages::errorWord::malformedMessage,
              QStringLiteral("a local node runs on the machine of its master; use udp")};
    return false;
}

std::unique_ptr<HubPeer> LocalKind::makePeer(const CyclicHub &hub, const Newcomer &, QJsonObject *answer,
                                             ChannelError *error) const
{
    auto memory = std::make_unique<SharedMemory>();
    if (!memory->create(sizeof(SharedChannel), &error->text)) {
        error->word = messages::errorWord::nodeError;
        return nullptr;
    }
    const LocalTransport::Paths paths = hub.find<LocalTransport>()->paths();
    messages::addFields(Answer{{memory->path(), paths.doorbell, paths.pipe}}, answer);
    return LocalTransport::peer(std::move(memory));
}

bool LocalKind::finishLink(const ControlEnds &ends, const QJsonObject &answer, std::unique_ptr<CyclicLink> *link,
                           QString *error) const
{
    const std::optional<uid_t> user = userOfPeer(ends.node, ends.master);
    if (user)
        *link = LocalLink::open(messages::fieldsOf<Answer>(answer), *user, error);
    else
        *error = QStringLiteral("cannot find out as which user the master at %1 runs, so none of its memory is "
                                "opened; use udp")
                     .arg(ends.masterText);
    return *link != nullptr;
}

}  // namespace qplc
