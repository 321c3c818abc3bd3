// SPDX-License-Identifier: Apache-2.0
#include "CyclicHub.h"
#include "LocalLink.h"
#include "LocalName.h"
#include "LocalTransport.h"
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
    bool open(CyclicHub &hub, const MasterPlace &place, QString *error) const override
    {
        return hub.find<LocalTransport>()->listen(place.session, error);
    }
    bool admits(const CyclicHub &hub, const Newcomer &node, ChannelError *error) const override;
    std::unique_ptr<HubPeer> makePeer(const CyclicHub &hub, const Newcomer &node, QJsonObject *answer,
                                      ChannelError *error) const override;
    bool beginLink(const ControlEnds &ends, QJsonObject *request, std::unique_ptr<CyclicLink> *link,
                   QString *error) const override;
    bool finishLink(const ControlEnds &ends, const QJsonObject &answer, std::unique_ptr<CyclicLink> *link,
                    QString *error) const override;

private:
    /// What a node says in Register.
    struct Request
    {
        messages::Hex64 localKey;

        static constexpr auto fields = messages::fieldList(messages::field("localKey", &Request::localKey));
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

std::unique_ptr<HubPeer> LocalKind::makePeer(const CyclicHub &hub, const Newcomer &node, QJsonObject *,
                                             ChannelError *error) const
{
    error->word = messages::errorWord::nodeError;
    const quint64 key = messages::fieldsOf<Request>(node.request).localKey;
    return hub.find<LocalTransport>()->link(key, node.volume, &error->text);
}

bool LocalKind::beginLink(const ControlEnds &ends, QJsonObject *request, std::unique_ptr<CyclicLink> *link,
                          QString *error) const
{
    std::unique_ptr<LocalLink> begun = LocalLink::begin(ends.session, error);
    if (begun)
        messages::addFields(Request{begun->key()}, request);
    *link = std::move(begun);
    return *link != nullptr;
}

bool LocalKind::finishLink(const ControlEnds &ends, const QJsonObject &, std::unique_ptr<CyclicLink> *link,
                           QString *error) const
{
    return static_cast<LocalLink *>(link->get())->finish(ends.volume, error);
}

}  // namespace qplc
