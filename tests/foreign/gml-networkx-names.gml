graph [
  node [
    id 0
    label "left wall.jpg"
  ]
  node [
    id 1
    label "a&#38;b.jpg"
  ]
  node [
    id 2
    label "Z&#252;rich <3>.jpg"
  ]
  node [
    id 3
    label "say &#34;x&#34;.jpg"
  ]
  node [
    id 4
    label "7"
  ]
  node [
    id 5
    label "dir/img_06.png"
  ]
  node [
    id 6
    label "&#233;'.png"
  ]
  edge [
    source 0
    target 1
  ]
  edge [
    source 0
    target 2
  ]
  edge [
    source 1
    target 2
  ]
  edge [
    source 1
    target 3
  ]
  edge [
    source 2
    target 3
  ]
  edge [
    source 2
    target 4
  ]
  edge [
    source 3
    target 4
  ]
  edge [
    source 3
    target 5
  ]
  edge [
    source 4
    target 5
  ]
  edge [
    source 4
    target 6
  ]
  edge [
    source 5
    target 6
  ]
]
