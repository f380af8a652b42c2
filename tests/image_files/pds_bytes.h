// Tiny planetary images, typed from the rules of their formats.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rockyard::image_files {

// Samples of 16 bits, most significant byte first.
inline std::string BigEndianSamples(const std::vector<int>& samples) {
  std::string bytes;
  for (const int sample : samples) {
    bytes += static_cast<char>(static_cast<unsigned>(sample) >> 8 & 0xffU);
    bytes += static_cast<char>(static_cast<unsigned>(sample) & 0xffU);
  }
  return bytes;
}

struct PdsText {
  int width = 0;
  int height = 0;
  std::string sample_type = "MSB_INTEGER";
  int sample_bits = 16;
  std::string mask = "2#0000111111111111#";  // "" for none
  int bands = 1;
  std::string data;
};

// PDS3 (Planetary Data System Standards Reference 3.8, chapters 5, 12 and A.20): an attached label
// of one record, then the pixels.
inline std::string Pds3Bytes(const PdsText& text) {
  constexpr std::size_t kRecordBytes = 1024;
  std::string label = "PDS_VERSION_ID = PDS3\r\nRECORD_TYPE = FIXED_LENGTH\r\nRECORD_BYTES = ";
  label += std::to_string(kRecordBytes) + "\r\nFILE_RECORDS = 2\r\nLABEL_RECORDS = 1\r\n^IMAGE = 2";
  label += "\r\nOBJECT = IMAGE\r\n  LINES = " + std::to_string(text.height);
  label += "\r\n  LINE_SAMPLES = " + std::to_string(text.width);
  label += "\r\n  SAMPLE_TYPE = " + text.sample_type;
  label += "\r\n  SAMPLE_BITS = " + std::to_string(text.sample_bits);
  if (!text.mask.empty()) label += "\r\n  SAMPLE_BIT_MASK = " + text.mask;
  label += "\r\n  BANDS = " + std::to_string(text.bands);
  label += "\r\n  BAND_STORAGE_TYPE = BAND_SEQUENTIAL\r\nEND_OBJECT = IMAGE\r\nEND\r\n";
  label.resize(kRecordBytes, ' ');
  return label + text.data;
}

// VICAR (The VICAR File Format, JPL 1992): a label of LBLSIZE bytes, then rows of 16 bits.
inline std::string VicarBytes(const PdsText& text) {
  constexpr std::size_t kLabelBytes = 512;
  std::string label =
      "LBLSIZE=512  FORMAT='HALF'  TYPE='IMAGE'  BUFSIZ=512  DIM=3  EOL=0  RECSIZE=";
  label += std::to_string(2 * text.width) + "  ORG='BSQ'  NL=" + std::to_string(text.height) +
           "  NS=" + std::to_string(text.width) + "  NB=1  N1=" + std::to_string(text.width) +
           "  N2=" + std::to_string(text.height) +
           "  N3=1  N4=0  NBB=0  NLB=0  HOST='SUN-SOLR'  INTFMT='HIGH'  REALFMT='RIEEE'  "
           "BHOST='SUN-SOLR'  BINTFMT='HIGH'  BREALFMT='RIEEE'  BLTYPE=''  COMPRESS='NONE'";
  if (!text.mask.empty()) label += "  PROPERTY='IMAGE_DATA'  SAMPLE_BIT_MASK='" + text.mask + "'";
  label.resize(kLabelBytes, '\0');
  return label + text.data;
}

// The label of PDS4 (PDS4 Information Model 1.14, Array_2D_Image), whose pixels lie in `file`.
inline std::string Pds4Label(const PdsText& text, const std::string& file) {
  const auto axis = [](const char* name, int elements, int number) {
    return std::string("<Axis_Array><axis_name>") + name + "</axis_name><elements>" +
           std::to_string(elements) + "</elements><sequence_number>" + std::to_string(number) +
           "</sequence_number></Axis_Array>";
  };
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Product_Observational "
         "xmlns=\"http://pds.nasa.gov/pds4/pds/v1\">\n<File_Area_Observational><File><file_name>" +
         file +
         "</file_name></File>\n<Array_2D_Image><offset unit=\"byte\">0</offset><axes>2</axes>"
         "<axis_index_order>Last Index Fastest</axis_index_order>\n<Element_Array>"
         "<data_type>UnsignedMSB2</data_type></Element_Array>\n" +
         axis("Line", text.height, 1) + axis("Sample", text.width, 2) +
         "</Array_2D_Image></File_Area_Observational>\n<sample_bit_mask>" + text.mask +
         "</sample_bit_mask>\n</Product_Observational>\n";
}

}  // namespace rockyard::image_files
