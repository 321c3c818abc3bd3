// SPDX-License-Identifier: Apache-2.0
#include "WireTap.h"

#include <QtCore/QHash>
#include <QtCore/QSet>

#include <dlfcn.h>
#include <mutex>
#include <sodium.h>
#include <sys/socket.h>

namespace {

std::mutex mutex;
bool isListening = false;
QVector<wire::Sent> sent;
QHash<QByteArray, QByteArray> frames;  // by key and nonce
wire::Seals counted;
QSet<QByteArray> keys;

template<typename Function>
Function original(const char *name)
{
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

QByteArray bytesOf(const void *data, std::size_t size)
{
    return QByteArray(static_cast<const char *>(data), int(size));
}

}  // namespace

namespace wire {

void listen()
{
    const std::lock_guard<std::mutex> lock(mutex);
    sent.clear();
    isListening = true;
}

QVector<Sent> heard()
{
    const std::lock_guard<std::mutex> lock(mutex);
    return sent;
}

QVector<Sent> heard(const std::function<bool(const Sent &)> &isWanted)
{
    QVector<Sent> wanted;
    for (const Sent &frame : heard()) {
        if (isWanted(frame))
            wanted << frame;
    }
    return wanted;
}

void forge(const Sent &before, const QByteArray &bytes)
{
    const auto *address
        = before.address.isEmpty() ? nullptr : reinterpret_cast<const sockaddr *>(before.address.constData());
    ::sendto(before.descriptor, bytes.constData(), std::size_t(bytes.size()), MSG_NOSIGNAL, address,
             socklen_t(before.address.size()));
}

void resetSeals()
{
    const std::lock_guard<std::mutex> lock(mutex);
    frames.clear();
    keys.clear();
    counted = {};
}

Seals seals()
{
    const std::lock_guard<std::mutex> lock(mutex);
    counted.keys = keys.size();
    return counted;
}

}  // namespace wire

extern "C" {

ssize_t send(int descriptor, const void *bytes, std::size_t size, int flags)
{
    static const auto sendOriginal = original<decltype(&send)>("send");
    const ssize_t count = sendOriginal(descriptor, bytes, size, flags);
    const std::lock_guard<std::mutex> lock(mutex);
    if (isListening && count > 0)
        sent.push_back({descriptor, QByteArray(), bytesOf(bytes, std::size_t(count))});
    return count;
}

int sendmmsg(int descriptor, mmsghdr *messages, unsigned count, int flags)
{
    static const auto sendOriginal = original<decltype(&sendmmsg)>("sendmmsg");
    const int done = sendOriginal(descriptor, messages, count, flags);
    const std::lock_guard<std::mutex> lock(mutex);
    for (int i = 0; isListening && i < done; ++i) {
        const msghdr &message = messages[i].msg_hdr;
        sent.push_back({descriptor, bytesOf(message.msg_name, message.msg_namelen),
                        bytesOf(message.msg_iov[0].iov_base, message.msg_iov[0].iov_len)});
    }
    return done;
}

int crypto_aead_chacha20poly1305_ietf_encrypt_detached(unsigned char *sealed, unsigned char *tag,
                                                       unsigned long long *tagSize, const unsigned char *plain,
                                                       unsigned long long size, const unsigned char *header,
                                                       unsigned long long headerSize, const unsigned char *none,
                                                       const unsigned char *nonce, const unsigned char *key)
{
    using Function = decltype(&crypto_aead_chacha20poly1305_ietf_encrypt_detached);
    static const auto seal = original<Function>("crypto_aead_chacha20poly1305_ietf_encrypt_detached");
    const int result = seal(sealed, tag, tagSize, plain, size, header, headerSize, none, nonce, key);
    const QByteArray frame = bytesOf(header, headerSize) + bytesOf(sealed, size) + bytesOf(tag, 16);
    const QByteArray place = bytesOf(key, 32) + bytesOf(nonce, 12);
    const std::lock_guard<std::mutex> lock(mutex);
    keys << place.left(32);
    ++counted.frames;
    const auto known = frames.constFind(place);
    if (known == frames.constEnd())
        frames.insert(place, frame);
    else if (*known == frame)
        ++counted.repeated;
    else
        ++counted.conflicts;
    return result;
}
}
