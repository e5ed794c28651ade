#pragma once
#include "encoder/live/stream_output.hpp"

#include <cstddef>
#include <cstdint>
#include <curl/curl.h>
#include <memory>
#include <span>
#include <string>

namespace tvg::cli {

/// Uploads a stream by PUT while it is made. write() returns when its bytes have been handed to the system.
/// Failures are ToolErrors (kIo) with the URL and what the server answered.
class HttpUpload final : public StreamOutput {
 public:
  explicit HttpUpload(std::string url);
  ~HttpUpload() override;
  HttpUpload(const HttpUpload&) = delete;
  HttpUpload& operator=(const HttpUpload&) = delete;

  void write(std::span<const std::uint8_t> bytes) override;
  void finish() override;

 private:
  static std::size_t give_bytes(char* target, std::size_t size, std::size_t count, void* upload);
  static std::size_t take_answer(char* bytes, std::size_t size, std::size_t count, void* upload);
  void drive(bool to_the_end);
  void read_messages();
  [[noreturn]] void fail(const std::string& reason) const;
  [[noreturn]] void fail_with_answer() const;

  struct EasyDeleter {
    void operator()(CURL* handle) const { curl_easy_cleanup(handle); }
  };
  struct MultiDeleter {
    void operator()(CURLM* handle) const { curl_multi_cleanup(handle); }
  };
  struct ListDeleter {
    void operator()(curl_slist* list) const { curl_slist_free_all(list); }
  };

  std::string url_;
  std::unique_ptr<curl_slist, ListDeleter> headers_;
  std::unique_ptr<CURLM, MultiDeleter> multi_;
  std::unique_ptr<CURL, EasyDeleter> easy_;
  std::span<const std::uint8_t> left_;  ///< of the bytes being written
  bool at_end_ = false;                 ///< no more will be written
  bool starved_ = false;                ///< curl has sent everything it was given and waits for more
  bool done_ = false;
  CURLcode result_ = CURLE_OK;
  std::string answer_;
};

}  // namespace tvg::cli
