/// \file
/// Messages between ranks, with what happens when one of them fails.
#pragma once

#include <exception>
#include <new>
#include <powercell/communicator.hpp>
#include <powercell/error.hpp>
#include <string>
#include <vector>

#include "lib/base/mailbox.hpp"

namespace powercell {

/// Each message ends with a byte that tells whether its sender has failed, so that all ranks fail in the same
/// exchange, with the same error.
class RankMailbox : public Mailbox {
 public:
  /// \throw Error invalid_argument (rank and size of the communicator)
  explicit RankMailbox(Communicator& communicator);

  int shards() const override { return communicator_.size(); }
  int first() const override { return communicator_.rank(); }
  const char* noun() const override { return "rank"; }
  std::vector<Letters> deliver(std::vector<Letters> letters) override;
  std::vector<Bytes> share(std::vector<Bytes> own) override;

  /// Does the work of this rank. Where it throws on some ranks, all others are told and throw too: the Error
  /// of the lowest of these ranks.
  template <class Work>
  auto together(const Work& work) {
    is_over_ = false;  // of an earlier call
    try {
      auto result = work();
      meet();  // others may have failed since the last exchange
      return result;
    } catch (const Error& error) {
      if (is_over_) throw;
      throw failed_together(error.code(), error.what());
    } catch (const std::bad_alloc&) {
      if (!is_over_) failed_together(ErrorCode::internal, "out of host memory");
      throw;
    } catch (const std::exception& error) {
      if (!is_over_) failed_together(ErrorCode::internal, error.what());
      throw;
    } catch (...) {
      if (!is_over_) failed_together(ErrorCode::internal, "an exception of unknown type");
      throw;
    }
  }

  /// Within together(): does work that throws on all ranks or on none, so that nobody needs to be told.
  template <class Work>
  auto nested(const Work& work) {
    is_over_ = true;  // unless it comes to its end
    auto result = work();
    is_over_ = false;
    return result;
  }
  /// Returns when all ranks have come here.
  /// \throw Error of a rank that has failed before
  void meet() { exchange(std::vector<Bytes>(static_cast<std::size_t>(shards()))); }

 private:
  /// \throw Error of a rank that has failed
  std::vector<Bytes> exchange(std::vector<Bytes> messages);
  /// Tells all ranks that this one has failed.
  /// \return the error of all
  Error failed_together(ErrorCode code, const std::string& what);

  Communicator& communicator_;
  bool is_over_ = false;  // all ranks know of a failure, or the communicator has failed
};

}  // namespace powercell
